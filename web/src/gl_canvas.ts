// The canvas of the graphics processor: its WebGL2 context, which the C++ module uses, and the loss of that context.
import type { GpuState } from './protocol';
import type { Module, DrawingModule } from './module';

export const attributes: WebGLContextAttributes = {
  alpha: false,
  antialias: false,
  depth: false,
  stencil: false,
  powerPreference: 'high-performance',
};

// Recognises WebGL2 without a graphics processor: the CPU engine is faster. Browsers do not say so directly, but the
// names of their software renderers do.
export const is_software = (name: string) => /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);

export function name_of(context: WebGL2RenderingContext): string {
  const unmasked = context.getExtension('WEBGL_debug_renderer_info');
  return String(context.getParameter(unmasked ? unmasked.UNMASKED_RENDERER_WEBGL : context.RENDERER));
}

export interface GlEvents {
  lost(): void;
  restored(): void;
}

export class GlCanvas {
  private context: WebGL2RenderingContext | null = null;
  private name = '';
  private why_not = '';

  constructor(
    private readonly module: Module,
    readonly canvas: OffscreenCanvas,
    see_through: boolean,
    events: GlEvents,
  ) {
    canvas.addEventListener('webglcontextcreationerror', (event) => {
      this.why_not = (event as WebGLContextEvent).statusMessage;
    });
    this.context = canvas.getContext('webgl2', { ...attributes, alpha: see_through });
    if (this.context) this.name = name_of(this.context);
    if (this.context) this.register();
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // else it never comes back
      events.lost();
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.register();
      events.restored();
    });
  }

  get here(): boolean {
    return this.context !== null && !this.context.isContextLost();
  }

  /** Drawn by the processor. */
  get software(): boolean {
    return is_software(this.name);
  }

  state(description: string): GpuState {
    return { here: this.here, software: this.software, name: this.name, why_not: this.why_not, description };
  }

  /** Lets another module draw on this canvas, too. */
  lend(module: DrawingModule): void {
    if (this.here) give_context(module, this.context!);
  }

  // Also after a loss: it asks for the extensions again and forgets the names of lost objects.
  private register(): void {
    give_context(this.module, this.context!);
  }
}

/** Lets the C++ module draw with this context. */
export function give_context(module: DrawingModule, context: WebGL2RenderingContext): void {
  const handle = module.GL.registerContext(context, { majorVersion: 2, minorVersion: 0, enableExtensionsByDefault: true });
  module.GL.makeContextCurrent(handle);
}
