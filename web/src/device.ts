// The measuring device, for the files that go from a page to `bihive thesis --device`.

let model = ''; // a phone's, from browsers that report it
interface AgentData {
  getHighEntropyValues?(names: string[]): Promise<{ model?: string }>;
}
void (navigator as { userAgentData?: AgentData }).userAgentData
  ?.getHighEntropyValues?.(['model'])
  .then((values) => (model = values.model ?? ''))
  .catch(() => undefined);

/** A JSON text: a description of the device, and its facts by name. */
export function describe_device(gpu: string, thread_count: number, version: string): string {
  const threads = `${thread_count} threads`;
  const gpu_name = gpu || 'no WebGL2';
  return JSON.stringify({
    device: [model, gpu_name, threads, navigator.userAgent].filter(Boolean).join('; '),
    model,
    gpu: gpu_name,
    browser: navigator.userAgent,
    screen: `${screen.width} x ${screen.height}, ${devicePixelRatio} pixels each`,
    threads,
    version,
  });
}
