# SPDX-License-Identifier: MIT
"""Which atoms of a box full of them are neighbours, how crowded is it, and which clash with a wall?"""

import allpairs
import numpy as np

rng = np.random.default_rng(42)
centres = rng.uniform(0.0, 100.0, (100_000, 3))
radii = rng.choice([0.5, 1.0, 1.5], 100_000)
lower, upper = centres - radii[:, None], centres + radii[:, None]

pairs = allpairs.overlaps(lower, upper)
print(f"{len(pairs):,} pairs of boxes overlap; array of {pairs.dtype}, shape {pairs.shape}")

gaps = np.linalg.norm(centres[pairs[:, 0]] - centres[pairs[:, 1]], axis=1) - radii[pairs].sum(axis=1)
print(f"{(gaps <= 0).sum():,} of them are spheres that touch")

degree = np.bincount(pairs.ravel(), minlength=len(centres))
print(f"the most crowded box overlaps {degree.max()} others, the average {degree.mean():.1f}")

wall = np.array([[0.0, 0.0, -1.0, 100.0, 100.0, 0.0]])
print(f"{allpairs.count_between((lower, upper), wall):,} boxes reach into the wall")

kinds = (radii / 0.5).astype(np.uint32)  # boxes of one kind are to be left out: a group each
print(f"{allpairs.count(lower, upper, group=kinds):,} pairs are of two kinds")

most = max(len(batch) for batch in allpairs.batches(lower, upper, distance=0.5, batch_size=10_000))
print(f"batches of {most:,} pairs at most")
