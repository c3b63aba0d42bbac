// Shadow tree of <ray-space-scene>. Pages style its parts: stage, bar, viewpoints, objects, message, progress, full-screen.

const kMarkup = `
<style>
  :host { display: block; position: relative; width: 100%; height: 400px; contain: content; background: #d8d8d4; }
  :host(:fullscreen) { width: 100%; height: 100%; }
  [part~="stage"] { position: absolute; inset: 0; cursor: grab; outline-offset: -3px; user-select: none; touch-action: none; }
  [part~="stage"]:active { cursor: grabbing; }
  canvas { display: block; width: 100%; height: 100%; pointer-events: none; }
  [part~="bar"] { position: absolute; left: 8px; right: 8px; bottom: 8px; display: flex; flex-wrap: wrap; gap: 8px; pointer-events: none;
    font: 0.875rem/1.4 system-ui, sans-serif; }
  [part~="bar"] > * { pointer-events: auto; }
  label { display: flex; align-items: center; gap: 6px; padding: 0 0 0 10px; border-radius: 6px; background: rgb(20 22 26 / 80%); color: #fff; }
  select { font: inherit; height: 36px; max-width: 12em; border: 0; border-radius: 6px; padding: 0 6px; background: #fff; color: #16181c; }
  [part~="message"] { position: absolute; inset: 0; display: grid; place-items: center; margin: 0; padding: 1em; text-align: center;
    pointer-events: none; font: 1rem/1.4 system-ui, sans-serif; color: CanvasText; overflow-wrap: anywhere; }
  [part~="message"]:not(:empty) { background: Canvas; border: 1px solid GrayText; }
  [part~="notice"] { position: absolute; left: 8px; top: 8px; margin: 0; padding: 6px 10px; border-radius: 6px; max-width: calc(100% - 40px);
    background: rgb(20 22 26 / 85%); color: #fff; font: 0.875rem/1.4 system-ui, sans-serif; pointer-events: none; }
  [part~="notice"]:empty { display: none; }
  [part~="progress"] { position: absolute; left: 10%; bottom: 50%; width: 80%; height: 6px; }
  [part~="full-screen"] { margin-left: auto; width: 36px; height: 36px; padding: 8px; border: 0; border-radius: 6px;
    background: rgb(20 22 26 / 80%); color: #fff; cursor: pointer; }
  [hidden] { display: none; }
</style>
<div part="stage" tabindex="0" role="application"></div>
<div part="bar">
  <label hidden>Viewpoint <select part="viewpoints"></select></label>
  <label hidden>Object <select part="objects"><option value="">none</option></select></label>
  <button part="full-screen" type="button" aria-label="Full screen" title="Full screen" hidden>
    <svg viewBox="0 0 20 20" width="20" height="20" fill="none" stroke="currentColor" stroke-width="2" aria-hidden="true">
      <path d="M2 7V2h5M13 2h5v5M18 13v5h-5M7 18H2v-5"/></svg>
  </button>
</div>
<p part="notice" aria-live="polite"></p>
<progress part="progress" aria-label="Loading the scene" max="1" value="0" hidden></progress>
<p part="message" role="alert"></p>`;

/** The parsed shadow tree. */
export function template(): HTMLTemplateElement {
  const made = document.createElement("template");
  made.innerHTML = kMarkup;
  return made;
}
