// In the worker: mounts the user's files for the module. Nothing is copied: it reads them in pieces.
import { unpacked } from './gunzip';
import type { Module } from './module';
import type { Files } from './protocol';

type Blobs = { name: string; data: Blob }[] | null;

export class UserFiles {
  private kept: Blobs = null; // of the shown scene
  private mounted: Blobs = null;

  constructor(private readonly module: Module) {
    module.FS.mkdir(this.path);
  }

  private get path(): string {
    return this.module.Page.folder().replace(/\/$/, '');
  }

  /** Replaces the previous files by these, until keep(); returns their names. Throws BadInput if one is broken. */
  async show(files: Files): Promise<{ name: string; trajectory: string }> {
    const plain = (name: string) => name.replaceAll('/', '_');
    const blobs = [{ name: plain(files.name), data: await unpacked(files.content, files.name) }];
    let trajectory = '';
    if (files.trajectory) {
      trajectory = plain(files.trajectory.name);
      if (trajectory === blobs[0]!.name) trajectory = `trajectory ${trajectory}`;
      blobs.push({ name: trajectory, data: await unpacked(files.trajectory.content, files.trajectory.name) });
    }
    this.mount(blobs);
    return { name: blobs[0]!.name, trajectory };
  }

  /** Whether their scene is shown now. If not, the previous files return: more of their frames may be needed. */
  keep(shown: boolean): void {
    if (shown) this.kept = this.mounted;
    else if (this.mounted !== this.kept) this.mount(this.kept);
  }

  /** The shown scene has no files. */
  forget(): void {
    this.mount(null);
    this.kept = null;
  }

  private mount(blobs: Blobs): void {
    if (this.mounted) this.module.FS.unmount(this.path);
    if (blobs) this.module.FS.mount(this.module.FS.filesystems.WORKERFS, { blobs }, this.path);
    this.mounted = blobs;
  }
}
