"""bihive: exact ray tracing of spheres. NumPy in, picture out.

>>> import numpy as np, bihive as bh
>>> s = bh.Spheres(np.random.default_rng(1).normal(size=(1000, 3)), radius=0.1)
>>> picture = bh.render(s, camera=bh.Orthographic("left"), style="illustrative", size=(80, 60))
>>> np.asarray(picture).shape
(60, 80, 3)

Spheres, read       spheres of arrays, of a file; Spheres.save, convert: into a file
render, film        pictures and films of them; Orthographic, Perspective, Look, Style determine their appearance
verify, again       a PNG of a picture drawn again and compared, or with changes
Tree                hits of rays, spheres near points, pairs of spheres
BodyTree, Sticks    hits of rays on spheres and sticks
view                the page in a browser, with spheres from memory; page and widget in a notebook, save_page as a file
select, stats       spheres that match an expression; statistics of the trees
distance            between centres of spheres; angle, dihedral
compare             trees and grids on the same spheres, by steps and by time
tune                the limits of a tree that suit spheres and machine
measure             exact area and volume of the union of spheres; sasa, volume, porosity, contacts, buried_area
colour_map          colours of numbers; linear: linear light as colours
Error               the base of all exceptions of this package
"""

from ._bihive import __version__
from ._bodies import AllBodyHits, BodyHits, BodyTree, Sticks
from ._camera import Look, Orthographic, Perspective, Style
from ._colours import linear
from ._compare import compare, tune
from ._errors import Error, FileError, InputError, InputWarning, MissingError, UsageError
from ._figures import Verdict, again, verify
from ._film import film
from ._hits import ClosestHits, HitDerivatives, Hits, Near, Pairs
from ._measures import angle, dihedral, distance
from ._picture import Picture
from ._render import render
from ._spheres import Spheres, colour_map, convert, read, select, stats
from ._tree import Tree
from ._union_measures import Contacts, Measures, buried_area, contacts, measure, porosity, sasa, volume
from ._view import Page, View, page, save_page, view
from ._widget import widget

__all__ = [
    "AllBodyHits",
    "BodyHits",
    "BodyTree",
    "ClosestHits",
    "Contacts",
    "Error",
    "FileError",
    "HitDerivatives",
    "Hits",
    "InputError",
    "InputWarning",
    "Look",
    "Measures",
    "MissingError",
    "Near",
    "Orthographic",
    "Page",
    "Pairs",
    "Perspective",
    "Picture",
    "Spheres",
    "Sticks",
    "Style",
    "Tree",
    "UsageError",
    "Verdict",
    "View",
    "__version__",
    "again",
    "angle",
    "buried_area",
    "colour_map",
    "compare",
    "contacts",
    "convert",
    "dihedral",
    "distance",
    "film",
    "linear",
    "measure",
    "page",
    "porosity",
    "read",
    "render",
    "sasa",
    "save_page",
    "select",
    "stats",
    "tune",
    "verify",
    "view",
    "volume",
    "widget",
]
