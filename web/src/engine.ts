// The worker from the page's side: requests go out, answers come in by type.
import { is_one_file, worker_inside } from './one_file';
import type { Answer, Request } from './protocol';

type Handlers = { [Type in Answer['type']]: (answer: Extract<Answer, { type: Type }>) => void };

export class Engine {
  private readonly worker = is_one_file
    ? worker_inside()
    : new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'bihive' });
  private next_id = 1;

  constructor(handlers: Handlers, on_broken: (message: string) => void) {
    this.worker.addEventListener('message', (event: MessageEvent<Answer>) => {
      const handler = handlers[event.data.type] as (answer: Answer) => void;
      handler(event.data);
    });
    this.worker.addEventListener('error', (event) => on_broken(event.message || 'The worker could not be started'));
  }

  send(request: Request, transfer: Transferable[] = []): void {
    this.worker.postMessage(request, transfer);
  }

  new_id(): number {
    return this.next_id++;
  }
}
