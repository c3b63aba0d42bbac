// The bundle of worker.ts as text (esbuild's --alias).
declare module "worker-source" {
  const source: string;
  export default source;
}
