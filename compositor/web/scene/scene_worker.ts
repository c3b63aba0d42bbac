// Worker of SceneWorkers. Its bundle is a string inside the script, so that a page needs one script only.

import { type SceneRequest, SceneServer } from "./scene_server.js";

const server = new SceneServer();
let last: Promise<void> = Promise.resolve();

self.onmessage = (event: MessageEvent<SceneRequest>) => {
  last = last.then(async () => {
    const answer = await server.answer(event.data);
    const view = "view" in answer ? answer.view : undefined;
    (self as unknown as Worker).postMessage(answer, view ? [view.pixels.buffer, view.depths.buffer] : []);
  });
};
