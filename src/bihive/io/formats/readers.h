// One reader for each format. It takes the whole file (already unpacked) and returns the content of one frame.
//
// `file` is the file's name for messages; `frame` counts from 0. None of them throws. Errors carry the line, and the
// column if there is one. docs/formats.md lists what each reader takes and leaves out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/frames/frame_index.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Formats of text with many frames, one behind the other: as the functions below, but from a scanner, which may be
/// that of a part of a file.
Result<RawSpheres> read_pdb(const TextScanner& scanner, const FramePass& pass);
Result<RawSpheres> read_pqr(const TextScanner& scanner, const FramePass& pass);
Result<RawSpheres> read_xyz(TextScanner scanner, const FramePass& pass);
Result<RawSpheres> read_gro(const TextScanner& scanner, const FramePass& pass);
Result<RawSpheres> read_lammps_dump(const TextScanner& scanner, const FramePass& pass);

/// Protein Data Bank, fixed columns: ATOM and HETATM records.
Result<RawSpheres> read_pdb(std::string_view text, const std::string& file, std::int64_t frame);

/// PQR: ATOM and HETATM lines of fields, with a charge and a radius at their end; any number of models.
Result<RawSpheres> read_pqr(std::string_view text, const std::string& file, std::int64_t frame);

/// mmCIF / PDBx: the _atom_site category of the first data block that has one.
Result<RawSpheres> read_mmcif(std::string_view text, const std::string& file, std::int64_t frame);

/// XYZ and extended XYZ: a count, a comment, one line a sphere; any number of frames.
Result<RawSpheres> read_xyz(std::string_view text, const std::string& file, std::int64_t frame);

/// LAMMPS dump in text (styles atom and custom); any number of frames.
Result<RawSpheres> read_lammps_dump(std::string_view text, const std::string& file, std::int64_t frame);

/// GRO of GROMACS, fixed columns; any number of frames. Lengths become Angstrom.
Result<RawSpheres> read_gro(std::string_view text, const std::string& file, std::int64_t frame);
/// Whether the line is one of GRO's atoms.
bool is_gro_atom(std::string_view line);

/// LAMMPS data file: a box and atoms in one of LAMMPS' styles. One frame.
Result<RawSpheres> read_lammps_data(std::string_view text, const std::string& file, std::int64_t frame);

/// Structure of VASP (POSCAR, CONTCAR). One frame.
Result<RawSpheres> read_poscar(std::string_view text, const std::string& file, std::int64_t frame);

/// Trajectory of VASP (XDATCAR); any number of frames.
Result<RawSpheres> read_xdatcar(std::string_view text, const std::string& file, std::int64_t frame);

/// MOL and SDF of MDL, V2000 and V3000; each record is a frame.
Result<RawSpheres> read_sdf(std::string_view text, const std::string& file, std::int64_t frame);

/// MOL2 of Tripos; each molecule is a frame.
Result<RawSpheres> read_mol2(std::string_view text, const std::string& file, std::int64_t frame);

/// CIF of small molecules and crystals: the whole cell, by its symmetry; each data block with atoms is a frame.
Result<RawSpheres> read_small_cif(std::string_view text, const std::string& file, std::int64_t frame);

/// The points of PLY, in text or binary. One frame.
Result<RawSpheres> read_ply(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice);

/// Point clouds of PCL (PCD), in text, binary or packed. One frame.
Result<RawSpheres> read_pcd(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice);

/// The points of VTK's old format, in text or binary. One frame.
Result<RawSpheres> read_vtk_legacy(std::string_view bytes, const std::string& file, std::int64_t frame,
                                   const ColumnChoice& choice);

/// The points of VTK's XML format (.vtp .vtu .vts). One frame.
Result<RawSpheres> read_vtk_xml(std::string_view bytes, const std::string& file, std::int64_t frame,
                                const ColumnChoice& choice);

/// NPZ of NumPy: columns x, y, z, or one array of places, and other arrays of as many rows. One frame.
Result<RawSpheres> read_npz(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice);

/// Whether the first lines of a text are those of the format. is_small_cif: whether a CIF has fractional coordinates.
bool is_small_cif(std::string_view text);
bool is_pcd(std::string_view head);
bool is_vtk_xml(std::string_view head);
bool is_lammps_data(std::string_view head);
bool is_poscar(std::string_view head);
bool is_xdatcar(std::string_view head);
bool is_sdf(std::string_view head);
bool is_mol2(std::string_view head);

/// GSD of HOOMD-blue, binary; any number of frames.
Result<RawSpheres> read_gsd(std::string_view bytes, const std::string& file, std::int64_t frame);

/// CSV with a header line, or plain `x y z [r]` lines. One frame.
Result<RawSpheres> read_csv(std::string_view text, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice);

/// NumPy array of n x 3 (x, y, z) or n x 4 (x, y, z, r). One frame.
Result<RawSpheres> read_npy(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice);

/// The same by the columns' own names.
inline Result<RawSpheres> read_ply(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_ply(bytes, file, frame, {});
}
inline Result<RawSpheres> read_pcd(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_pcd(bytes, file, frame, {});
}
inline Result<RawSpheres> read_vtk_legacy(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_vtk_legacy(bytes, file, frame, {});
}
inline Result<RawSpheres> read_vtk_xml(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_vtk_xml(bytes, file, frame, {});
}
inline Result<RawSpheres> read_npz(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_npz(bytes, file, frame, {});
}
inline Result<RawSpheres> read_csv(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_csv(bytes, file, frame, {});
}
inline Result<RawSpheres> read_npy(std::string_view bytes, const std::string& file, std::int64_t frame) {
  return read_npy(bytes, file, frame, {});
}

}  // namespace bihive
