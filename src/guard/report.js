'use strict';
// Without this script the pictures stand side by side and all else can be read.
const kBlinkMs = 700;
const calm = matchMedia('(prefers-reduced-motion: reduce)');
const cases = [...document.querySelectorAll('.case')];
document.querySelectorAll('.modes, .keys, .copy').forEach(element => element.hidden = false);

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

// The case that keys act on: the first that reaches below the upper third of the window.
function current() {
  return Math.max(0, cases.findIndex(section => section.getBoundingClientRect().bottom > innerHeight / 3));
}

addEventListener('keydown', event => {
  if (event.ctrlKey || event.altKey || event.metaKey || cases.length === 0) return;
  const section = cases[current()];
  const mode = {1: 'side', 2: 'blink', 3: 'slide'}[event.key];
  const way = {j: 1, k: -1}[event.key.toLowerCase()];
  if (mode) {
    setMode(section, mode);
  } else if (way) {
    const inside = section.getBoundingClientRect().top < innerHeight / 3;
    const next = cases[current() + (way > 0 && !inside ? 0 : way)];
    if (next) {
      next.scrollIntoView();
      next.focus({preventScroll: true});
    }
  } else if (event.key === ' ' && section.querySelector('[data-mode=blink].pictures') &&
             !event.target.closest('button, summary, input')) {
    swapByHand(section);
    event.preventDefault();
  }
});
