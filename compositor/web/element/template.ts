// Shadow tree of <ray-space>. Pages style its parts: stage, poster, message, progress, full-screen,
// ground-shadow, interaction-prompt.

const kMarkup = `
<style>
  :host { display: block; position: relative; width: 300px; height: 300px; contain: content; }
  :host(:fullscreen) { background: #fff; width: 100%; height: 100%; }
  @media (prefers-color-scheme: dark) { :host(:fullscreen) { background: #16181c; } }
  [part~="stage"] { position: absolute; inset: 0; cursor: grab; outline-offset: -2px; user-select: none; }
  [part~="stage"]:active { cursor: grabbing; }
  [part~="stage"][role="img"] { cursor: default; }
  [part~="stage"] { isolation: isolate; }
  canvas { display: block; width: 100%; height: 100%; pointer-events: none; }
  [part~="ground-shadow"] { position: absolute; left: 0; top: 0; width: 128px; height: 128px; z-index: -1; transform-origin: 0 0; }
  .concealed canvas, .concealed .hotspot { visibility: hidden; }
  .cover { position: absolute; inset: 0; pointer-events: none; }
  .cover ::slotted(*) { pointer-events: auto; }
  .hotspots { position: absolute; inset: 0; overflow: hidden; pointer-events: none; isolation: isolate; }
  .hotspot { position: absolute; left: 0; top: 0; }
  ::slotted([slot^="hotspot"]) { pointer-events: auto; opacity: var(--max-hotspot-opacity, 1); transition: opacity 0.3s; }
  .hide ::slotted([slot^="hotspot"]) { pointer-events: none; opacity: var(--min-hotspot-opacity, 0); }
  [part~="interaction-prompt"] { position: absolute; left: 50%; bottom: 12px; transform: translateX(-50%); padding: 6px 14px;
    border-radius: 99px; background: rgb(0 0 0 / 55%); color: #fff; font: 0.85rem/1.4 system-ui, sans-serif; pointer-events: none;
    display: flex; align-items: center; gap: 8px; white-space: nowrap; opacity: 0; visibility: hidden;
    transition: opacity 0.5s, visibility 0.5s; }
  [part~="interaction-prompt"].shown { opacity: 1; visibility: visible; }
  @media (prefers-reduced-motion: reduce) { ::slotted(*), [part~="interaction-prompt"] { transition: none !important; } }
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
<div part="stage" class="concealed"><canvas part="ground-shadow" width="1" height="1" hidden></canvas></div>
<div class="hotspots concealed"></div>
<div class="cover"><slot name="poster"><img part="poster" alt="" hidden></slot></div>
<p part="message" role="alert"></p>
<progress part="progress" aria-label="Loading" max="1" value="0" hidden></progress>
<div part="interaction-prompt" aria-hidden="true"><slot name="interaction-prompt">
  <svg viewBox="0 0 32 16" width="32" height="16" fill="none" stroke="currentColor" stroke-width="2" stroke-linecap="round">
    <path d="M6 4L2 8l4 4M26 4l4 4-4 4M2 8h8M22 8h8"/><circle cx="16" cy="8" r="3.5"/></svg><span class="hint"></span></slot></div>
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
