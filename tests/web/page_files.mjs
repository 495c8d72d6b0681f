// Small files of every format that the page takes, and the ways in.
import assert from 'node:assert/strict';
import { gzipSync } from 'node:zlib';

function npy(rows) {
  const header = `{'descr': '<f4', 'fortran_order': False, 'shape': (${rows.length}, 4), }`.padEnd(117) + '\n';
  const start = Buffer.concat([Buffer.from('\x93NUMPY\x01\x00', 'latin1'), Buffer.from([118, 0]), Buffer.from(header)]);
  return Buffer.concat([start, Buffer.from(new Float32Array(rows.flat()).buffer)]);
}
const pdb_line = (serial, name, x, element) =>
  `HETATM${String(serial).padStart(5)}  ${name.padEnd(3)} LIG A   1    ${x.toFixed(3).padStart(8)}   0.000   0.000` +
  `  1.00  0.00          ${element.padStart(2)}\n`;
const cif_columns = ['group_PDB', 'id', 'type_symbol', 'label_atom_id', 'label_alt_id', 'label_comp_id', 'label_asym_id',
  'label_entity_id', 'label_seq_id', 'Cartn_x', 'Cartn_y', 'Cartn_z', 'occupancy', 'B_iso_or_equiv', 'auth_asym_id'];
/** Files of every format, and how many spheres are in each: {name, spheres, format, bytes}. */
export const made_files = [
  ['three.pdb', 3, 'PDB', pdb_line(1, 'C1', 0, 'C') + pdb_line(2, 'O1', 1.4, 'O') + pdb_line(3, 'N1', -1.4, 'N') + 'END\n'],
  ['two.cif', 2, 'mmCIF', `data_TWO\nloop_\n${cif_columns.map((name) => `_atom_site.${name}\n`).join('')}` +
    'HETATM 1 C C1 . LIG A 1 . 0 0 0 1 0 A\nHETATM 2 O O1 . LIG A 1 . 1.4 0 0 1 0 A\n#\n'],
  ['four.xyz', 4, 'XYZ', '4\nammonia\nN 0 0 0\nH 0.9 0.3 0\nH -0.9 0.3 0\nH 0 0.3 0.9\n'],
  ['five.lammpstrj', 5, 'LAMMPS dump', 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n5\nITEM: BOX BOUNDS pp pp pp\n' +
    '0 9\n0 9\n0 9\nITEM: ATOMS id type x y z\n' + [1, 2, 3, 4, 5].map((i) => `${i} 1 ${i} 2 3\n`).join('')],
  ['six.csv', 6, 'CSV', 'x,y,z,r\n' + [1, 2, 3, 4, 5, 6].map((i) => `${i},0,0,0.${i}\n`).join('')],
  ['seven.npy', 7, 'NPY', npy([1, 2, 3, 4, 5, 6, 7].map((i) => [i, 0, 0, 0.5]))],
  ['eight.xyz.gz', 8, 'XYZ', gzipSync(`8\ncarbon\n${[1, 2, 3, 4, 5, 6, 7, 8].map((i) => `C ${i} 0 0\n`).join('')}`)],
  ['one.json', 1, 'scene file', '{"bihive_scene": 1, "spheres": [[0, 0, 0, 1]]}'],
].map(([name, spheres, format, content]) => ({ name, spheres, format, bytes: Buffer.from(content) }));

/** A CSV file of this many points without radii, no two of them in one place. */
export function points_in_a_cube(count) {
  const side = Math.ceil(Math.cbrt(count));
  const lines = ['x,y,z'];
  for (let i = 0; i < count; ++i) {
    const [x, y, z] = [i % side, Math.floor(i / side) % side, Math.floor(i / side / side)];
    lines.push(`${x + ((i * 7919) % 101) / 250},${y + ((i * 104729) % 103) / 250},${z}`);
  }
  return `${lines.join('\n')}\n`;
}

/** How a file gets into the page; by its address, it must be on the server under file/. */
export const ways_in = {
  picker: (page, { name, bytes }) =>
    page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer: bytes }),
  drop: async (page, { name, bytes }) => {
    const dataTransfer = await page.evaluateHandle(
      ([called, base64]) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([Uint8Array.from(atob(base64), (byte) => byte.charCodeAt(0))], called));
        return transfer;
      },
      [name, bytes.toString('base64')],
    );
    await page.dispatchEvent('#picture', 'dragover', { dataTransfer });
    assert.ok(await page.isVisible('#drop_hint'));
    await page.dispatchEvent('#picture', 'drop', { dataTransfer });
    assert.ok(await page.isHidden('#drop_hint'));
  },
  address: async (page, { name }) => {
    await page.fill('#url', `file/${name}`);
    await page.press('#url', 'Enter');
  },
};

/** A trajectory in CHARMM's and NAMD's format, records of bytes between their lengths: of each frame the places of all atoms. */
export function dcd(frames) {
  const record = (bytes) => {
    const length = Buffer.alloc(4);
    length.writeInt32LE(bytes.length);
    return Buffer.concat([length, bytes, length]);
  };
  const header = Buffer.alloc(84);
  header.write('CORD', 0, 'latin1');
  for (const [at, value] of [[1, frames.length], [2, 0], [3, 1], [4, frames.length], [20, 24]]) header.writeInt32LE(value, 4 * at);
  const title = Buffer.alloc(84, ' ');
  title.writeInt32LE(1, 0);
  const count = Buffer.alloc(4);
  count.writeInt32LE(frames[0].length);
  const parts = [record(header), record(title), record(count)];
  for (const places of frames)
    for (const axis of [0, 1, 2]) {
      const values = Buffer.alloc(4 * places.length);
      places.forEach((place, i) => values.writeFloatLE(place[axis], 4 * i));
      parts.push(record(values));
    }
  return Buffer.concat(parts);
}
