// In the worker: draws the pictures of a film, and encodes them by WebCodecs.
import { film_colours, i420_of } from './film_pixels';
import { BadInput, value_of, type Page } from './module';
import { PictureRun } from './picture_run';
import type { Camera, FilmRequest, Settings } from './protocol';
import { equally_far, turned } from './turntable';
import { webm_of, type EncodedFrame, type FilmFormat } from './webm';

const key_every = 25; // frames
const bits_per_pixel = 0.5; // of a frame: edges of spheres stay sharp
const least_bits = 2e6; // per second
const codecs = [['V_VP9', 'vp09.00.51.08'], ['V_VP8', 'vp8']] as const;

// The browser's first codec for this size.
async function chosen_codec({ width_px: width, height_px: height, frames_per_second }: FilmRequest) {
  for (const [codec, name] of codecs) {
    const config = { codec: name, width, height, framerate: frames_per_second, bitrate: Math.ceil(Math.max(least_bits, bits_per_pixel * width * height * frames_per_second)) };
    if ((await VideoEncoder.isConfigSupported(config)).supported) return { codec, config };
  }
  throw new BadInput(`This browser encodes no film of ${width} × ${height} pixels: try a smaller one`);
}

export class FilmRun {
  private run: PictureRun | null = null;
  private ended = false;
  private reason: BadInput | null = null;

  constructor(
    private readonly page: Page,
    private readonly progress: (done: number) => void,
  ) {}

  /** The film as a WebM file, or null if cancelled. Camera and frame are then as before. Throws BadInput if it cannot be made. */
  async draw(request: FilmRequest): Promise<Blob | null> {
    const { camera, samples_per_pixel } = JSON.parse(this.page.settings()) as Settings;
    const { frame } = JSON.parse(this.page.player()) as { frame: number };
    const cameras = request.turn ? this.cameras(camera, request) : null;
    const count = cameras?.length ?? request.frames;
    const { codec, config } = await chosen_codec(request);
    const encoded: EncodedFrame[] = [];
    let fault: Error | null = null;
    const encoder = new VideoEncoder({
      output: (chunk) => {
        const bytes = new Uint8Array(chunk.byteLength);
        chunk.copyTo(bytes);
        encoded.push({ bytes, time_ms: Math.round(chunk.timestamp / 1000), is_key: chunk.type === 'key' });
      },
      error: (error) => (fault = error),
    });
    encoder.configure(config);
    const step_us = 1e6 / request.frames_per_second;
    try {
      for (let i = 0; i < count && !this.ended && !fault; ++i) {
        if (cameras) this.set_camera(cameras[i]!);
        else this.show_frame(i);
        this.run = new PictureRun(this.page, (done) => this.progress((i + done) / count));
        const drawn = await this.run.draw_pixels({ ...request, samples_per_pixel });
        if (!drawn) break;
        const picture = new VideoFrame(i420_of(this.page.pixels(), drawn.channels, drawn.width, drawn.height), {
          format: 'I420', codedWidth: drawn.width, codedHeight: drawn.height, timestamp: Math.round(i * step_us), duration: Math.round(step_us),
          colorSpace: film_colours,
        });
        encoder.encode(picture, { keyFrame: i % key_every === 0 });
        picture.close();
      }
      if (!this.ended && !fault) await encoder.flush();
      if (fault) throw new BadInput(`The browser could not encode the film: ${(fault as Error).message}`);
    } finally {
      if (encoder.state !== 'closed') encoder.close();
      if (cameras) this.set_camera(camera);
      else this.show_frame(frame);
    }
    if (this.reason) throw this.reason;
    const format: FilmFormat = { codec, width: request.width_px, height: request.height_px, duration_ms: (count * step_us) / 1000 };
    return this.ended ? null : webm_of(encoded, format);
  }

  /** Ends it before the next step; with a reason it is an error. */
  cancel(reason: BadInput | null = null): void {
    this.ended = true;
    this.reason = reason;
    this.run?.cancel();
  }

  // Once around, from where the camera is.
  private cameras(camera: Camera, { turn, frames, keep_in_view, width_px, height_px }: FilmRequest): Camera[] {
    const cameras = Array.from({ length: frames }, (_, i) => turned(camera, turn!, (360 * i) / frames));
    if (!keep_in_view) return cameras;
    return equally_far(cameras, (one) => value_of<Settings>(this.page.far_enough(JSON.stringify({ camera: one }), width_px, height_px)).camera);
  }

  private set_camera(camera: Camera): void {
    value_of(this.page.set(JSON.stringify({ camera })));
  }

  private show_frame(frame: number): void {
    this.page.go_to_frame(frame);
    value_of(this.page.continue_playing(performance.now()));
  }
}
