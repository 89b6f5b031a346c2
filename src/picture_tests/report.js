'use strict';
// Without this script the pictures stand side by side and all else can be read.
const kBlinkMs = 700;
const calm = matchMedia('(prefers-reduced-motion: reduce)');
const cases = [...document.querySelectorAll('.case')];
document.querySelectorAll('.modes, .keys, .copy, .orders').forEach(element => element.hidden = false);

function setMode(section, mode) {
  const pictures = section.querySelector('.pictures');
  if (!section.querySelector('.modes')) return;
  pictures.dataset.mode = mode;
  pictures.classList.remove('swapped', 'byhand');
  section.querySelectorAll('[data-mode][aria-pressed]').forEach(
    button => button.setAttribute('aria-pressed', button.dataset.mode === mode));
  section.querySelector('.swap').hidden = mode !== 'blink';
  section.querySelector('.slider').hidden = mode !== 'slide';
}

function swapByHand(section) {
  const pictures = section.querySelector('.pictures');
  pictures.classList.add('byhand');
  pictures.classList.toggle('swapped');
}

setInterval(() => {
  if (calm.matches) return;
  document.querySelectorAll('.pictures[data-mode=blink]:not(.byhand)').forEach(
    pictures => pictures.classList.toggle('swapped'));
}, kBlinkMs);

cases.filter(section => section.querySelector('.modes')).forEach(section => {
  section.querySelectorAll('button[data-mode]').forEach(
    button => button.addEventListener('click', () => setMode(section, button.dataset.mode)));
  section.querySelector('.swap').addEventListener('click', () => swapByHand(section));
  const slider = section.querySelector('input');
  slider.addEventListener('input', () =>
    section.querySelector('.pictures').style.setProperty('--at', slider.value + '%'));
});

document.querySelectorAll('.thumbnail').forEach(button => button.addEventListener('click', () =>
  button.setAttribute('aria-pressed', button.getAttribute('aria-pressed') !== 'true')));

document.querySelectorAll('.copy').forEach(button => button.addEventListener('click', async () => {
  const code = button.parentElement.querySelector('code');
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = 'Copied';
  } catch {
    // Where a page may not write to the clipboard, the text is at least selected.
    getSelection().selectAllChildren(code);
    button.textContent = 'Press Ctrl+C';
  }
}));

document.querySelectorAll('.orders button').forEach(button => button.addEventListener('click', () => {
  const orders = button.parentElement;
  orders.querySelectorAll('button').forEach(other => other.setAttribute('aria-pressed', other === button));
  const list = orders.parentElement.querySelector('.sorted');
  const byName = (a, b) => a.dataset.name < b.dataset.name ? -1 : a.dataset.name > b.dataset.name;
  const byPixels = (a, b) =>
    b.dataset.pixels - a.dataset.pixels || b.dataset.largest - a.dataset.largest || byName(a, b);
  list.append(...[...list.children].sort(button.dataset.by === 'name' ? byName : byPixels));
}));

// The case that has the focus and is seen, or -1.
function focused() {
  const index = cases.indexOf(document.activeElement.closest('.case'));
  if (index < 0) return -1;
  const {top, bottom} = cases[index].getBoundingClientRect();
  return bottom > 0 && top < innerHeight ? index : -1;
}

// The case that keys act on: else the first that reaches below the upper third of the window.
function current() {
  const below = cases.findIndex(section => section.getBoundingClientRect().bottom > innerHeight / 3);
  return focused() >= 0 ? focused() : below;
}

function goTo(section) {
  if (!section) return;
  section.scrollIntoView();
  section.focus({preventScroll: true});
}

addEventListener('keydown', event => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const section = cases[current()];
  if (!section) return;
  const key = event.key.toLowerCase();
  const mode = {1: 'side', 2: 'blink', 3: 'slide'}[key];
  if (mode) setMode(section, mode);
  if (key === 'j') goTo(focused() >= 0 ? cases[focused() + 1] : section);
  if (key === 'k') goTo(cases[current() - 1]);
  if (key === 's' && section.querySelector('.pictures[data-mode=blink]')) swapByHand(section);
});
