# SPDX-License-Identifier: MIT
"""Pairs of 2D boxes by shapely's STRtree: shapely_pairs.py BOXES.npy PAIRS.npy; columns 0, 1, 3 and 4 count."""

import sys

import numpy as np
import shapely
from shapely.geometry import box
from shapely.strtree import STRtree


def pairs_of(rows):
    boxes = [box(*row) for row in rows[:, [0, 1, 3, 4]].astype(np.float64).tolist()]
    tree = STRtree(boxes)
    if hasattr(tree, "query_items"):  # shapely 1.8
        partners = [tree.query_items(one) for one in boxes]
        first = np.repeat(np.arange(len(boxes)), list(map(len, partners)))
        second = np.concatenate(partners)
    else:  # shapely 2
        first, second = tree.query(boxes)
    found = np.stack([first, second], axis=1)
    return found[found[:, 0] < found[:, 1]].astype(np.uint32)


if len(sys.argv) == 3:
    np.save(sys.argv[2], pairs_of(np.load(sys.argv[1])))
else:
    print(shapely.__version__)
