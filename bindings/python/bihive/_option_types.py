"""The types of options, written by scripts/settings_tables from the tables of options."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Literal, Mapping, Optional, Sequence, TypedDict, Union

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._colours import Linear

__all__ = ["FilmOptions", "ReadOptions", "RenderOptions"]

Path = Union[str, "os.PathLike[str]"]
Colour = Union[str, Sequence[float], "Linear"]


class ReadOptions(TypedDict, total=False):
    """Options of read() and convert(); None: as if left out."""

    radius: Optional[float]  # Radius of every sphere (scenarios: 1)
    radius_scale: Optional[float]  # Files: multiply every radius
    frame: Optional[int]  # Files: which frame or model, from 0; -1 is the last (0)
    trajectory: Optional[Path]  # Files: coordinates of the same spheres per frame (DCD, H5MD, NetCDF of AMBER, TRR and XTC)
    smooth: Optional[int]  # Files with frames: means of coordinates over N frames, an odd number, with the frame in the middle
    recenter: Optional[bool]  # Files: move the middle of the set to the origin
    assembly: Optional[Union[str, int]]  # PDB, mmCIF: copy the chains as this biological assembly says, e.g. 1; bihive info lists them
    columns: Optional[Mapping[str, Union[str, float]]]  # CSV, HDF5, LAMMPS dump, NetCDF, NPY, NPZ, PCD, PLY, VTK, VTK XML and XYZ: columns by name or position, e.g. x=px,y=py,z=pz,r=5
    replicate: Optional[tuple[int, int, int]]  # Files: this many copies along the vectors of the periodic cell
    cell_vectors: Optional[Sequence[float]]  # Files: the three vectors of the cell (the file's)
    cell_origin: Optional[Sequence[float]]  # Files: the corner of the cell (the file's, else 0,0,0)
    periodic: Optional[bool]  # Files: distances see the images of the periodic cell (usual); bihive trace and measure too
    wrap: Optional[Union[bool, Literal["molecules"]]]  # Files: move every centre into the cell
    wrap_molecules: Optional[bool]  # Files: bring molecules together, and move each into the cell as a whole; also as the value molecules of wrap
    unwrap: Optional[bool]  # Files: bring together what belongs together, by the columns ix, iy, iz, else by mol, bonds or residues
    exposed_area: Optional[float]  # Files: add the column exposed_area, the surface of each sphere that a probe of radius R reaches
    count: Optional[int]  # Scenarios: number of spheres (4096)
    seed: Optional[int]  # Scenarios: the seed of their random numbers (1)


class RenderOptions(ReadOptions, total=False):
    """Options of render(), and of films and figures; None: as if left out."""

    crop: Optional[Sequence[float]]  # Draw only this rectangle of its pixels, counted from the top left corner; X1, Y1 are exclusive
    view: Optional[Literal["shaded", "recursion", "traversal", "normal", "distance", "id", "tree"]]  # Quantity to draw (shaded)
    samples: Optional[Union[int, Literal["auto"]]]  # Samples per pixel, 1 to 4096 (files: 4, thesis scenes: 1, with an aperture 64); auto: 4, and 16 on edges
    recursion: Optional[int]  # Generations of rays; 1: primary rays only (5)
    matte: Optional[Colour]  # With a transparent background: the colour that will lie behind the picture, to which edges, fog and letters are fitted
    fit_share: Optional[float]  # The share of the spheres, along each axis, that the camera brings into view: 0.98 leaves out 1 % at either end (1, or the style's)
    stereo: Optional[Literal["none", "side", "cross", "anaglyph"]]  # Views of both eyes: next to each other, the same for crossed eyes, or red and cyan (none)
    eye_distance: Optional[float]  # Of stereo pictures: the distance between the eyes as a share of that to the camera's target (1/30)
    transfer: Optional[Literal["srgb", "none"]]  # Curve from radiance to pixels (files: srgb, thesis scenes: none)
    background: Optional[Colour]  # A name, #rrggbb, r,g,b from 0 to 1, or none: transparent (files: white)
    floor: Optional[Colour]  # A plane below the spheres: in a colour, or seen by the shadows on it alone
    bits: Optional[Literal[8, 16]]  # Bits of each number in the picture (8)
    dpi: Optional[int]  # Pixels per inch in print: for letters, lines in points, and a note in the file
    light: Optional[Union[str, Sequence[str]]]  # The lights (the style's or the scene's): thesis|studio|cloudy|headlight, from:RIGHT,UP,TOWARDS[:COLOUR[:STRENGTH[:DEG]]] around the camera, or at:X,Y,Z[:COLOUR[:STRENGTH[:RADIUS]]] in the world; repeatable
    shadows: Optional[bool]  # Spheres cast shadows (files: yes, thesis scenes: no)
    ao: Optional[bool]  # Ambient occlusion: surfaces that see little of their surroundings are darker
    ao_distance: Optional[float]  # Reach of ambient occlusion in world units (no limit); implies --ao
    ao_directions: Optional[int]  # Directions of ambient occlusion per sample (64); implies --ao
    opacity_rule: Optional[Literal["each_surface", "once", "first", "as_one"]]  # Whether a transparent sphere weakens light at each surface, once, if it is the first of its opacity along a ray, or as one body with those of its opacity that overlap it (the style's)
    light_points: Optional[int]  # Shadow rays per area light and sample (the style's)
    fog: Optional[float]  # Share of the background at the set's farthest point; 0: none (the style's)
    fog_start: Optional[float]  # Depth where fog begins: 0 at the set's nearest point, 1 at its farthest (0); implies --fog
    fog_end: Optional[float]  # Depth where fog reaches its full strength; above its start (1); implies --fog
    outline_step: Optional[float]  # Minimum depth step at an outline, in radii of the sphere in front (2)
    outline_colour: Optional[Colour]  # Colour of outlines (black)
    line_unit: Optional[Literal["px", "picture", "pt"]]  # Unit of the widths of outlines, creases and cell edges: pixels, 1/720 of the picture's shorter side, or points in print (styles: picture, scene files: px)
    bonds: Optional[Literal["none", "distance", "file", "auto"]]  # Draw sticks between bonded atoms: those nearer than their covalent radii allow, those that the file states, or both (docs/pictures.md) (the style's)
    bond_reach: Optional[float]  # The longest bond, in sums of both atoms' covalent radii (1.2)
    bond_orders: Optional[bool]  # Draw double and triple bonds of the file as parallel sticks, aromatic ones with a dashed one (the style's)
    stick_radius: Optional[float]  # Radius of the sticks in world units (0.15, or the style's)
    ball_scale: Optional[float]  # With bonds: multiplies all radii; 0: balls as thick as the sticks (1, or the style's)
    arrows: Optional[Union[str, npt.ArrayLike]]  # Draw an arrow on each sphere, along the vector that these attributes are; arithmetic too: fx/m,fy/m,fz/m
    arrow_select: Optional[str]  # The spheres that have arrows (all)
    arrow_scale: Optional[float]  # Length of an arrow in world units, for a vector of length 1 (1)
    arrow_share: Optional[float]  # Length of the longest arrow as a share of the set's longest side, in place of the scale; 0: by the scale (0)
    arrow_radius: Optional[float]  # Radius of the shafts of arrows in world units (a quarter of the sphere's)
    arrow_pivot: Optional[Literal["tail", "middle"]]  # The point of an arrow that is at the centre of its sphere (tail)
    arrow_colour: Optional[Union[Colour, str]]  # Colour of arrows, or an attribute that colours them, with a map and a range (the sphere's)
    trace: Optional[Literal["none", "chain", "mol"]]  # Draw a tube through the beads of each chain, or of each molecule of the column mol (none)
    trace_select: Optional[str]  # The beads of tubes (CA and P, or all where there are none)
    trace_radius: Optional[Union[Union[float, str], npt.ArrayLike]]  # Radius of tubes in world units: a number, an attribute, or arithmetic: b_factor/50 (a quarter of the bead's)
    trace_atoms: Optional[Literal["hidden", "shown"]]  # Whether the spheres of traced residues are drawn too (hidden)
    trail: Optional[int]  # Draw the path of each sphere through the N frames before as a thin stick that fades; 0: none (0)
    trail_select: Optional[str]  # The spheres that have trails (all)
    trail_radius: Optional[float]  # Radius of trails in world units (a fifth of the sphere's)
    hbonds: Optional[bool]  # Draw hydrogen bonds as dashes, found by distance and angle (docs/pictures.md)
    hbond_radius: Optional[float]  # Radius of the dashes of hydrogen bonds in world units (0.06)
    hbond_colour: Optional[Colour]  # Colour of hydrogen bonds (blue)
    show_contacts: Optional[float]  # Draw a link between each two spheres in contact, found with a probe of this radius (docs/measures.md) (none)
    link_radius: Optional[Union[float, str]]  # Radius of links in world units, or F times a column such as area (a quarter of the smaller sphere's)
    link_colour: Optional[Union[Colour, str]]  # Colour of links, or a column that colours them, such as area:magma (their spheres')
    link_dashes: Optional[bool]  # Draw links as dashes
    show_cavities: Optional[float]  # In place of the spheres draw the walls of the cavities that they enclose, where a probe of this radius can be (docs/measures.md) (none)
    exposure: Optional[float]  # Stops: all light times 2^EV; the background keeps its colour (the style's)
    tone: Optional[Literal["none", "soft", "filmic"]]  # Curve for light that is too bright for the picture (the style's)
    view_from: Optional[str]  # Show the whole set from this side (files: front); principal: its longest axis along the picture's longer side; best: the direction that shows most of a selection
    eye: Optional[Sequence[float]]  # Camera position
    look_at: Optional[Union[Sequence[float], str]]  # The middle of the picture: a point, or the centre of the spheres of a selection; the eye stays
    fit: Optional[str]  # These spheres alone are fitted into the picture, as if there were no others: the camera goes near them, and others may be beside or behind it
    zoom_to: Optional[str]  # Magnify until these spheres fill the picture: the camera keeps its direction and distance, and shows what stands before them
    up: Optional[Sequence[float]]  # The direction that is up in the picture
    fov: Optional[float]  # Angle along the shorter side (30; less in pictures over twice as wide as high)
    projection: Optional[Literal["perspective", "orthographic"]]  # orthographic: equal spheres look equally large at any distance (perspective)
    turn: Optional[Sequence[float]]  # Degrees: the camera moves AZ to the right and EL up around its target; the picture turns ROLL counter-clockwise
    zoom: Optional[float]  # Magnify everything F times (1)
    aperture: Optional[float]  # Depth of field: the radius of the lens, in world units; 0: everything is sharp (0)
    focus: Optional[Union[float, str]]  # With an aperture: the distance that is sharp, in world units, or the spheres that are, such as 'resname LIG' or 'index 12' (auto: the camera's target)
    engine: Optional[Literal["auto", "wide", "reference", "brute", "wide-brute", "gpu", "gpu-brute"]]  # The engine (auto): those of the CPU give the same bits, a graphics processor nearly the same
    max_prims: Optional[Union[int, Literal["unlimited"]]]  # Maximum spheres per leaf (the engine's choice; reference: 8)
    max_depth: Optional[Union[int, Literal["unlimited"]]]  # Maximum levels of the tree (the engine's choice; reference: unlimited)
    tune: Optional[bool]  # Search the tree's limits that suit these spheres, in about ten seconds, as bihive tune does; pictures keep their bits
    threads: Optional[int]  # Threads (0: as many as the machine runs at once)
    colour: Optional[Union[Colour, npt.ArrayLike]]  # Colour them: a name, #rrggbb or r,g,b from 0 to 1
    colour_by: Optional[Union[str, npt.ArrayLike, tuple[npt.ArrayLike, str]]]  # Colour them by an attribute or an expression of some; MIN,MAX also 2%,98%. MAP, or MAP_r reversed: viridis, magma, plasma, inferno, cividis, turbo, greys, coolwarm, RdBu, okabe-ito, colours such as blue-white-red, or a file of some
    nan_colour: Optional[Colour]  # Colour of unknown numbers in the attribute that gives colours (grey)
    opacity: Optional[Union[float, npt.ArrayLike]]  # Their opacity, 0 (clear) to 1
    material: Optional[Literal["matte", "plastic", "metal", "glass", "flat", "toon"]]  # Their material (the style's)
    outline: Optional[float]  # After a selection: width of their outlines, 1 to 16; 0: none. Before: of all (the style's)
    crease: Optional[str]  # Lines between those that touch and differ in it, such as chain
    legend_name: Optional[str]  # Name them in the legend: beside their colour, or above the key of their colour-by
    clip: Optional[Union[str, Sequence[str]]]  # Cut them open: n.x > D, the box or the sphere is removed; repeatable
    element_colours: Optional[Path]  # Colours of elements: a name, or a file with lines 'C #909090' (the style's)
    no_hydrogens: Optional[bool]  # Hide hydrogen
    no_water: Optional[bool]  # Hide water
    cell: Optional[bool]  # Draw the edges of the periodic cell, and of its copies
    cell_width: Optional[float]  # Width of the cell's edges in line units (2); implies --cell
    cell_colour: Optional[Colour]  # Colour of the cell's edges (nearly black; light before a dark background); implies --cell
    title: Optional[str]  # Title at the top; {time}, {step}, {frame}, {spheres} are values of the frame, {time:.2f} has two digits after the point
    legend: Optional[bool]  # Legend of the colours: a colour bar, or names
    legend_title: Optional[str]  # Title of the legend's colour bar or names, with its unit (the attribute's name)
    axes: Optional[bool]  # Show the directions of x, y and z
    scale_bar: Optional[bool]  # Show a round length of the world; for orthographic pictures
    length_unit: Optional[str]  # Unit after the scale bar's number (PDB, mmCIF: Å; else none)
    title_values: Optional[Path]  # CSV: a row for each frame, from 0; the first line names the columns: {NAME}
    font: Optional[Path]  # Font of titles, legends and the rest: TrueType or OpenType (DejaVu Sans)
    no_labels: Optional[bool]  # None of the labels that the scene file or the style asks for
    links: Optional[Union[Path, npt.ArrayLike, Mapping[str, npt.ArrayLike]]]  # Draw a stick for each row of a CSV file, whose columns first and second are the numbers of two spheres, from 0


class FilmOptions(RenderOptions, total=False):
    """Options of film(); those here are for films of files; None: as if left out."""

    pictures: Optional[int]  # Number of pictures of an input with one frame (ten seconds, or all keys)
    hold_first: Optional[int]  # Show the first picture N more times (0)
    hold_last: Optional[int]  # Show the last picture N more times (0)
    reverse: Optional[bool]  # Show the pictures backwards
    ping_pong: Optional[bool]  # Show the pictures forwards, then backwards, without the ends: the film loops
    turntable: Optional[float]  # Rotation of the camera around the scene, over the whole film
    turn_axis: Optional[Literal["x", "y", "z", "picture"]]  # Axis of --turntable: x, y or z of the world, or the picture's vertical (the world's up direction)
    follow: Optional[str]  # The camera moves with these spheres, through the boundaries of a periodic cell too
    align: Optional[str]  # Move and turn all spheres of each frame until these lie over those of the first frame
    fit_frames: Optional[Literal["first", "all", "each"]]  # The frames whose spheres the camera brings into view: the first, all of them (reads the film twice), or each picture those of its own (first)
    camera_keys: Optional[Path]  # Key frames of the camera: docs/films.md
    colour_range: Optional[Literal["first", "film", "frame"]]  # Ranges of --colour-by without MIN,MAX: of the first frame, of the whole film (reads it twice), or of each frame (first)
    codec: Optional[str]  # ffmpeg's options for the codec (H.264, webm: VP9): '-c:v libx265 -crf 20'
    shard: Optional[str]  # Draw every N-th picture from number i on; another command joins all N
