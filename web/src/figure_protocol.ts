// The messages between the page and its worker for figures.

export interface NamedBlob {
  name: string;
  content: Blob;
}

export interface FigureRequest {
  base: string;
  threads: boolean;
  figure: NamedBlob;
  inputs: NamedBlob[]; // files that it may have been drawn from
}

/** The last one is `missing`, `verdict` or `failed`. */
export type FigureAnswer =
  | { type: 'record'; drawn_by: string; from: string }
  | { type: 'missing'; names: string; other_bytes: string } // other_bytes: those whose name is there
  | { type: 'progress'; done: number }
  | { type: 'verdict'; holds: boolean; words: string }
  | { type: 'failed'; message: string };
