// Shadow tree of <ray-space>. Pages style its parts: stage, poster, message, progress, full-screen.

const kMarkup = `
<style>
  :host { display: block; position: relative; width: 300px; height: 300px; contain: content; }
  :host(:fullscreen) { background: #fff; width: 100%; height: 100%; }
  @media (prefers-color-scheme: dark) { :host(:fullscreen) { background: #16181c; } }
  [part~="stage"] { position: absolute; inset: 0; cursor: grab; outline-offset: -2px; user-select: none; }
  [part~="stage"]:active { cursor: grabbing; }
  [part~="stage"][role="img"] { cursor: default; }
  canvas { display: block; width: 100%; height: 100%; pointer-events: none; }
  [part~="poster"] { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; pointer-events: none; }
  [part~="message"] { position: absolute; inset: 0; display: grid; place-items: center; margin: 0; padding: 1em; text-align: center;
    pointer-events: none; font: 1rem/1.4 system-ui, sans-serif; color: CanvasText; overflow-wrap: anywhere; }
  [part~="message"]:not(:empty) { background: Canvas; border: 1px solid GrayText; }
  [part~="message"][data-below] { inset: auto 0 0; padding: 0.4em 1em; }
  [part~="progress"] { position: absolute; left: 10%; bottom: 8%; width: 80%; height: 4px; }
  [part~="full-screen"] { position: absolute; right: 8px; bottom: 8px; width: 36px; height: 36px; padding: 8px; border: 0;
    border-radius: 6px; background: rgb(0 0 0 / 45%); color: #fff; cursor: pointer; }
  [part~="direction"] { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
  [hidden] { display: none; }
</style>
<div part="stage"></div>
<img part="poster" alt="" hidden>
<p part="message" role="alert"></p>
<progress part="progress" aria-label="Loading" max="1" value="0" hidden></progress>
<button part="full-screen" type="button" aria-label="Full screen" title="Full screen" hidden>
  <svg viewBox="0 0 20 20" width="20" height="20" fill="none" stroke="currentColor" stroke-width="2" aria-hidden="true">
    <path d="M2 7V2h5M13 2h5v5M18 13v5h-5M7 18H2v-5"/></svg>
</button>
<span part="direction" aria-live="polite"></span>`;

/** The parsed shadow tree. */
export function template(): HTMLTemplateElement {
  const made = document.createElement("template");
  made.innerHTML = kMarkup;
  return made;
}
