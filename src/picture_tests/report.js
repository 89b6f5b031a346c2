'use strict';
// Without this script the pictures stand side by side, and all that is said of them can be read.
const kBlinkMs = 700;
const kZooms = [0, 1, 2, 4, 8];  // screen pixels for one of the picture; 0: all of it is seen
const kSlideReach = 24;          // how near to the line a drag moves it, not the pictures
const kClickReach = 5;           // how far a click may move
const kCell = 32;                // pixels on a side of the squares, of which the one that differs most is enlarged

const all = (selector, within = document) => [...within.querySelectorAll(selector)];
const one = (selector, within = document) => within.querySelector(selector);
const calm = matchMedia('(prefers-reduced-motion: reduce)');
const cases = all('.case');
const decision = one('.decision');  // where nothing can be accepted, there is none
const filter = one('#filter');
const chips = all('.chip');
const orders = all('.orders button');
const links = new Map(all('nav a').map(link => [link.hash.slice(1), link]));

document.documentElement.classList.add('scripted');
all('.tools, .modes, .take, .decision').forEach(element => element.hidden = false);
all('details .copy').forEach(element => element.hidden = false);
if (matchMedia('(max-width: 700px)').matches) all('details.roomy').forEach(details => details.open = false);

// What stays at the top and at the bottom of the window.
for (const [name, edge] of [['--head', one('header')], ['--foot', decision]].filter(([, edge]) => edge)) {
  const measure = () => {
    const sticky = getComputedStyle(edge).position === 'sticky';
    document.documentElement.style.setProperty(name, (sticky ? edge.offsetHeight : 0) + 'px');
  };
  measure();
  new ResizeObserver(measure).observe(edge);
}

// --- what the page shows, as its address says it, so that a link shows the same

// The case that was gone to last, by name.
let gone = '';

const box = section => one('.take input', section);
const marked = () => cases.filter(section => box(section)?.checked);
const pressed = button => button.getAttribute('aria-pressed') === 'true';
const press = (button, on) => button.setAttribute('aria-pressed', on);

function keep() {
  const state = new URLSearchParams();
  if (filter.value) state.set('filter', filter.value);
  const hidden = chips.filter(chip => !pressed(chip)).map(chip => chip.dataset.chip);
  if (hidden.length) state.set('hide', hidden.join(' '));
  const by = orders.find(pressed).dataset.by;
  if (by !== 'outcome') state.set('sort', by);
  for (const section of marked()) state.append('accept', section.dataset.name);
  if (gone) state.set('case', gone);
  const hash = state.toString();
  history.replaceState(null, '', hash ? '#' + hash : location.pathname + location.search);
}

function restore() {
  const plain = cases.find(section => '#' + section.id === location.hash);
  const state = new URLSearchParams(plain ? '' : location.hash.slice(1));
  filter.value = state.get('filter') ?? '';
  const hidden = (state.get('hide') ?? '').split(' ');
  chips.forEach(chip => press(chip, !hidden.includes(chip.dataset.chip)));
  const taken = state.getAll('accept');
  cases.forEach(section => { if (box(section)) box(section).checked = taken.includes(section.dataset.name); });
  sortBy(orders.find(button => button.dataset.by === state.get('sort')) ?? orders[0]);
  show();
  const section = plain ?? cases.find(candidate => candidate.dataset.name === state.get('case'));
  if (section && !section.hidden) goTo(section);
}

// --- filter and order

const items = all('main [data-outcome], nav [data-outcome]');
const texts = new Map(items.map(item =>
  [item, [item.dataset.name, ...all('.words', item).map(words => words.textContent)].join(' ').toLowerCase()]));
// A row of the list has the words of its case.
all('nav li').forEach(row => texts.set(row, texts.get(one(one('a', row).hash))));

const ofMain = items.filter(item => item.closest('main'));

function show() {
  const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
  const matches = item => words.every(word => texts.get(item).includes(word));
  const shown = new Set(chips.filter(pressed).map(chip => chip.dataset.chip));
  const found = {};
  for (const item of items) {
    const is = matches(item);
    item.hidden = !is || !shown.has(item.dataset.outcome);
    if (is && item.closest('main')) found[item.dataset.outcome] = (found[item.dataset.outcome] ?? 0) + 1;
  }
  chips.forEach(chip => one('.count', chip).textContent = found[chip.dataset.chip] ?? 0);
  const left = ofMain.filter(item => !item.hidden);
  one('.shown').textContent = left.length === ofMain.length ? '' : `${left.length} of ${ofMain.length} shown`;
  one('.nothing').hidden = left.length > 0 || ofMain.length === 0;
  const seen = cases.some(section => !section.hidden);
  for (const details of all('main > details')) {
    const mine = ofMain.filter(item => details.contains(item));
    const count = mine.filter(item => !item.hidden).length;
    details.hidden = count === 0;
    one('.count', details).textContent = count === mine.length ? count : `${count} of ${mine.length}`;
    // What is looked for is not left folded.
    if (left.length < ofMain.length && !seen && count > 0) details.open = true;
  }
  showMarked();
  showCurrent();
}

const originally = new Map(items.map((item, index) => [item, index]));
const kOrders = {
  outcome: (a, b) => originally.get(a) - originally.get(b),
  name: (a, b) => a.dataset.name < b.dataset.name ? -1 : Number(a.dataset.name > b.dataset.name),
  pixels: (a, b) => b.dataset.pixels - a.dataset.pixels || b.dataset.largest - a.dataset.largest || kOrders.name(a, b),
};

function sortBy(button) {
  orders.forEach(other => press(other, other === button));
  all('.sorted').forEach(list => list.append(...[...list.children].sort(kOrders[button.dataset.by])));
}

filter.addEventListener('input', () => { show(); keep(); });
chips.forEach(chip => chip.addEventListener('click', () => { press(chip, !pressed(chip)); show(); keep(); }));
orders.forEach(button => button.addEventListener('click', () => { sortBy(button); keep(); }));

function clearText() {
  filter.value = '';
  show();
  keep();
}
one('.showall').addEventListener('click', () => {
  chips.forEach(chip => press(chip, true));
  clearText();
});

// --- what is marked, and the command that takes it

const takeable = cases.filter(box);

function showMarked() {
  if (!decision) return;
  const taken = marked();
  for (const section of takeable) {
    section.classList.toggle('taken', box(section).checked);
    links.get(section.id)?.parentElement.classList.toggle('taken', box(section).checked);
  }
  const unseen = taken.filter(section => section.hidden).length;
  one('.marked').textContent =
    `${taken.length} of ${takeable.length} marked` + (unseen > 0 ? `, ${unseen} of them not shown` : '');
  one('.unmark').hidden = taken.length === 0;
  const {before, after} = decision.dataset;
  const words = taken.map(section => section.dataset.word).join(' ');
  // Behind -- a name may begin with a dash.
  const dash = taken.some(section => section.dataset.name.startsWith('-'));
  one('code', decision).textContent = dash ? `${before}${after} -- ${words}` : `${before} ${words}${after}`;
  one('.command', decision).hidden = one('.copy', decision).hidden = taken.length === 0;
  one('.copy', decision).textContent = 'Copy';
}

function mark(sections, on) {
  sections.filter(box).forEach(section => box(section).checked = on);
  showMarked();
  keep();
}

takeable.forEach(section => box(section).addEventListener('change', () => mark([], true)));
one('.markall')?.addEventListener('click', () => mark(shownCases(), true));
one('.unmark')?.addEventListener('click', () => mark(takeable, false));

all('.copy').forEach(button => button.addEventListener('click', async () => {
  const code = one('code', button.parentElement);
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = 'Copied';
  } catch {
    // Where a page may not write to the clipboard, the text is at least selected.
    getSelection().selectAllChildren(code);
    button.textContent = 'Press Ctrl+C';
  }
}));

// --- two pictures in turn or side by side

let chosenMode = 'side';

function setMode(section, mode) {
  const button = one(`button[data-mode=${mode}]`, section);
  if (!button) return;
  const pictures = one('.pictures', section);
  pictures.dataset.mode = mode;
  pictures.classList.remove('swapped', 'byhand');
  all('button[data-mode]', section).forEach(other => press(other, other === button));
  one('.swap', section).hidden = mode !== 'blink';
  one('.slider', section).hidden = mode !== 'slide';
  place(section);
}

function chooseMode(section, mode) {
  chosenMode = mode;
  setMode(section, mode);
}

function swapByHand(section) {
  const pictures = one('.pictures[data-mode=blink]', section);
  if (!pictures) return;
  pictures.classList.add('byhand');
  pictures.classList.toggle('swapped');
}

setInterval(() => {
  if (!calm.matches)
    all('.pictures[data-mode=blink]:not(.byhand)').forEach(pictures => pictures.classList.toggle('swapped'));
}, kBlinkMs);

function slide(section, percent) {
  const at = Math.min(Math.max(percent, 0), 100);
  one('.slider input', section).value = at;
  one('.pictures', section).style.setProperty('--at', at + '%');
}

// --- zoom: all pictures of a case show the same point in their middle

const views = new Map();  // of cases with pictures: zoom, x, y in pixels of the picture

// Where most differs, or the middle of the picture.
function worstOf(section) {
  const [actual, golden] = ['actual', 'golden'].map(kind => one(`.${kind} img`, section));
  const {naturalWidth, naturalHeight} = actual ?? golden;
  const worst = {x: naturalWidth / 2, y: naturalHeight / 2, sum: 0};
  const rect = one('.sheet rect', section);
  if (!rect) return worst;
  const [left, top, width, height] = ['x', 'y', 'width', 'height'].map(side => Number(rect.getAttribute(side)));
  const canvas = new OffscreenCanvas(width, height).getContext('2d');
  canvas.drawImage(golden, -left, -top);
  canvas.globalCompositeOperation = 'difference';
  canvas.drawImage(actual, -left, -top);
  const {data} = canvas.getImageData(0, 0, width, height);
  const columns = Math.ceil(width / kCell);
  const sums = new Uint32Array(columns * Math.ceil(height / kCell));
  for (let i = 0, pixel = 0; i < data.length; i += 4, ++pixel) {
    const cell = Math.floor(pixel % width / kCell) + Math.floor(pixel / width / kCell) * columns;
    sums[cell] += data[i] + data[i + 1] + data[i + 2];
  }
  sums.forEach((sum, cell) => {
    if (sum <= worst.sum) return;
    const middle = (index, side) => Math.min((index + .5) * kCell, side - .5);
    Object.assign(worst, {sum, x: left + middle(cell % columns, width), y: top + middle(Math.floor(cell / columns), height)});
  });
  return worst;
}

// How much larger a picture is drawn than where all of it is seen.
function scaleOf(paper, zoom) {
  return paper.clientWidth ? Math.max(zoom * one('img', paper).getAttribute('width') / paper.clientWidth, 1) : 1;
}

function place(section) {
  const view = views.get(section);
  if (!view) return;
  one('.pictures', section).classList.toggle('enlarged', view.zoom > 0);
  one('.enlarge span', section).textContent = view.zoom > 0 ? `${100 * view.zoom} %` : 'fit';
  for (const paper of all('.paper', section)) {
    const scale = scaleOf(paper, view.zoom);
    const unit = paper.clientWidth / one('img', paper).getAttribute('width') * scale;
    const shift = (middle, side) => Math.min(Math.max(side / 2 - middle * unit, side * (1 - scale)), 0);
    const sheet = one('.sheet', paper);
    sheet.style.transform =
      scale > 1 ? `translate(${shift(view.x, paper.clientWidth)}px, ${shift(view.y, paper.clientHeight)}px) scale(${scale})` : '';
    sheet.style.setProperty('--scale', scale);
  }
}

// The first level beyond the present one at which the pictures are larger; from the last the first.
function zoom(section, step, point) {
  const view = views.get(section);
  const paper = all('.paper', section).find(candidate => candidate.clientWidth);
  if (!view || !paper) return;
  const levels = kZooms.filter(level => level === 0 || scaleOf(paper, level) > 1);
  const index = (Math.max(levels.indexOf(view.zoom), 0) + step + levels.length) % levels.length;
  if (point) Object.assign(view, point);
  else if (view.zoom === 0) Object.assign(view, worstOf(section));
  view.zoom = levels[index];
  place(section);
}

// In pixels of the picture.
function pointIn(paper, event) {
  const {left, top, width} = one('.sheet', paper).getBoundingClientRect();
  const unit = width / one('img', paper).getAttribute('width');
  return {x: (event.clientX - left) / unit, y: (event.clientY - top) / unit};
}

function drag(section, paper, event) {
  if (event.button !== 0) return;
  const view = views.get(section);
  const pictures = one('.pictures', section);
  const bounds = paper.getBoundingClientRect();
  const at = (event.clientX - bounds.left) / bounds.width * 100;
  const line = Number(one('.slider input', section)?.value);
  const slides = pictures.dataset.mode === 'slide' &&
    (view.zoom === 0 || Math.abs(at - line) / 100 * bounds.width < kSlideReach);
  const begin = {x: view.x, y: view.y};
  const unit = one('.sheet', paper).getBoundingClientRect().width / one('img', paper).getAttribute('width');
  let moved = 0;
  const move = now => {
    const dx = now.clientX - event.clientX, dy = now.clientY - event.clientY;
    moved = Math.max(moved, Math.hypot(dx, dy));
    if (slides) slide(section, (now.clientX - bounds.left) / bounds.width * 100);
    else if (view.zoom > 0 && moved > kClickReach) {
      const img = one('img', paper);
      const within = (value, side, most) => Math.min(Math.max(value, side / 2 / unit), most - side / 2 / unit);
      view.x = within(begin.x - dx / unit, bounds.width, img.getAttribute('width'));
      view.y = within(begin.y - dy / unit, bounds.height, img.getAttribute('height'));
      place(section);
    }
  };
  const end = now => {
    for (const [name, listener] of listeners) paper.removeEventListener(name, listener);
    if (now.type === 'pointerup' && !slides && moved <= kClickReach) zoom(section, 1, pointIn(paper, now));
  };
  const listeners = [['pointermove', move], ['pointerup', end], ['pointercancel', end]];
  for (const [name, listener] of listeners) paper.addEventListener(name, listener);
  paper.setPointerCapture(event.pointerId);
  if (slides && event.pointerType === 'mouse') slide(section, at);
}

for (const section of cases.filter(candidate => one('.pictures', candidate))) {
  views.set(section, {zoom: 0, x: 0, y: 0});
  one('.enlarge', section).addEventListener('click', () => zoom(section, 1));
  all('button[data-mode]', section).forEach(
    button => button.addEventListener('click', () => chooseMode(section, button.dataset.mode)));
  one('.swap', section)?.addEventListener('click', () => swapByHand(section));
  one('.slider input', section)?.addEventListener('input', event => slide(section, event.target.value));
  all('.paper', section).forEach(paper => paper.addEventListener('pointerdown', event => drag(section, paper, event)));
  all('.paper img', section).forEach(img => img.draggable = false);
}
addEventListener('resize', () => views.forEach((view, section) => { if (view.zoom > 0) place(section); }));

all('.thumbnail').forEach(button => button.addEventListener('click', () => press(button, !pressed(button))));

// --- from case to case

const shownCases = () => all('.case:not([hidden])');

// The case that has the focus and is seen, or -1.
function focused(shown) {
  const index = shown.indexOf(document.activeElement.closest('.case'));
  if (index < 0) return -1;
  const {top, bottom} = shown[index].getBoundingClientRect();
  return bottom > 0 && top < innerHeight ? index : -1;
}

// The case that keys act on: else the first that reaches below the upper third of the window, or, at the top of the
// page, below the bar.
function current(shown) {
  if (focused(shown) >= 0) return focused(shown);
  const line = scrollY > 0 ? innerHeight / 3 : one('header').getBoundingClientRect().bottom;
  return shown.findIndex(section => section.getBoundingClientRect().bottom > line);
}

function showCurrent() {
  const shown = shownCases();
  const id = shown[current(shown)]?.id;
  // Where nobody has gone to a case yet, the list shows it paler.
  const how = focused(shown) >= 0 ? 'true' : 'location';
  links.forEach((link, of) => of === id ? link.setAttribute('aria-current', how) : link.removeAttribute('aria-current'));
}

function goTo(section) {
  if (!section) return;
  gone = section.dataset.name;
  setMode(section, chosenMode);
  section.scrollIntoView();
  section.focus({preventScroll: true});
  showCurrent();
}

links.forEach((link, id) => link.addEventListener('click', event => {
  event.preventDefault();
  goTo(document.getElementById(id));
  keep();
}));

let waiting = false;
addEventListener('scroll', () => {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; showCurrent(); });
}, {passive: true});

// --- keys

const keys = one('#keys');
one('.helps').addEventListener('click', () => keys.showModal());
one('.closes').addEventListener('click', () => keys.close());

const kModes = {1: 'side', 2: 'blink', 3: 'slide', 4: 'heat'};

addEventListener('keydown', event => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing || keys.open) return;
  const shown = shownCases();
  const index = current(shown);
  const section = shown[index];
  const go = to => { goTo(to); keep(); };
  if (event.target === filter) {
    if (event.key === 'Escape') clearText();
    if (event.key === 'Enter') go(shown[0]);
    if (event.key === 'Escape') filter.blur();
    return;
  }
  const actions = {
    j: () => go(focused(shown) >= 0 ? shown[index + 1] : section),
    k: () => go(shown[index - 1]),
    s: () => section && swapByHand(section),
    z: () => section && zoom(section, event.shiftKey ? -1 : 1),
    a: () => event.shiftKey ? mark(shown, true) : section && box(section) && mark([section], !box(section).checked),
    '/': () => { filter.focus(); filter.select(); },
    '?': () => keys.showModal(),
    escape: clearText,
  };
  // A key that is held goes on from case to case; it does nothing else twice.
  if (event.repeat && !'jk'.includes(event.key.toLowerCase())) return;
  const mode = kModes[event.key];
  const action = mode ? () => section && chooseMode(section, mode) : actions[event.key.toLowerCase()];
  if (!action) return;
  event.preventDefault();
  action();
});

addEventListener('hashchange', restore);
restore();
