// Bundle of scene_worker.ts as text (esbuild's --alias).
declare module "scene-worker-source" {
  const source: string;
  export default source;
}
