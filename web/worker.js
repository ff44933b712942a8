// The program beside the page: the first message is the program, each other one is work, and is answered by its product.

import { initSync, work } from "./soapfilm.js";

let program;

onmessage = ({ data }) => {
  if (!program) {
    program = initSync({ module: data });
    return;
  }
  const product = work(data);
  postMessage(product, [product.buffer]);
};
