// The worker of CoreRenderer. Its bundle is a string inside the element's script, so that a page needs one script only.

import { buffersOf, CoreServer, type Request } from "./core_server.js";

const server = new CoreServer();
let last: Promise<void> = Promise.resolve();

// Requests are answered in their order.
self.onmessage = (event: MessageEvent<Request>) => {
  last = last.then(async () => {
    const answer = await server.answer(event.data);
    (self as unknown as Worker).postMessage(answer, buffersOf(answer));
  });
};
