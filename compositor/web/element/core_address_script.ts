// Address of the WebAssembly module for a classic script: beside the script, or beside the page if the script is part of it.
const script = (document.currentScript as HTMLScriptElement | null)?.src;
export const coreAddress = new URL("ray-space.wasm", script || document.baseURI).href;
