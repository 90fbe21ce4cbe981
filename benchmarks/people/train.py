"""`python -m benchmarks.people.train`: make scans, train the forest of legs, write its file.

Needs scikit-learn (`pip install -e .[train]`), which nothing else does.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

import robot.perception.people as home
from benchmarks.people.scenes import NOBODY, a_laser, a_room, seen
from robot.perception.people.clusters import clusters
from robot.perception.people.scan import Array
from robot.perception.people.shape import NAMES, WIDEST_M, shape

FILE = Path(home.__path__[0]) / "leg_forest.npz"


def examples(count: int, seed: int) -> tuple[Array, Array]:
    """Shapes of clusters of synthetic scans, and whether each is of legs."""
    random = np.random.default_rng(seed)
    shapes: list[Array] = []
    are_legs: list[bool] = []
    for _ in range(count):
        scan, whose = seen(a_room(random), a_laser(random), random)
        for cluster in clusters(scan):
            if np.linalg.norm(cluster.points_m[-1] - cluster.points_m[0]) > WIDEST_M:
                continue
            share = float((whose[cluster.begin : cluster.end] != NOBODY).mean())
            if 0.1 < share < 0.7:
                continue  # legs that touch something: neither
            shapes.append(shape(scan, cluster))
            are_legs.append(share >= 0.7)
    return np.array(shapes), np.array(are_legs)


def main(
    *,
    scans: Annotated[int, typer.Option(help="to train on")] = 12_000,
    trees: Annotated[int, typer.Option(help="of the forest")] = 48,
    leaves: Annotated[int, typer.Option(help="of a tree, at most")] = 160,
    seed: Annotated[int, typer.Option()] = 0,
) -> None:
    """Train, say how well it does on rooms it was not trained on, write the file."""
    from sklearn.ensemble import RandomForestClassifier  # pyright: ignore

    shapes, legs = examples(scans, seed)
    forest = RandomForestClassifier(
        n_estimators=trees, max_leaf_nodes=leaves, min_samples_leaf=5, max_features=6,
        class_weight="balanced", random_state=seed,
    ).fit(shapes, legs)  # fmt: skip
    unseen, truth = examples(1000, seed + 1)
    found = forest.predict_proba(unseen)[:, 1]
    for threshold in (0.3, 0.4, 0.5, 0.6, 0.7):
        said = found > threshold
        right = float((said & truth).sum())
        print(f"{threshold}: precision {right / said.sum():.3f} recall {right / truth.sum():.3f}")
    weights = sorted(zip(forest.feature_importances_, NAMES, strict=True), reverse=True)
    print(", ".join(f"{name} {weight:.2f}" for weight, name in weights))
    arrays = [estimator.tree_ for estimator in forest.estimators_]
    starts = np.cumsum([0, *(tree.node_count for tree in arrays)])[:-1]
    np.savez_compressed(
        FILE,
        roots=starts.astype(np.int32),
        feature=np.concatenate([np.maximum(tree.feature, -1) for tree in arrays]).astype(np.int16),
        threshold=np.concatenate([tree.threshold for tree in arrays]).astype(np.float32),
        left=np.concatenate(
            [
                np.maximum(tree.children_left, 0) + at
                for tree, at in zip(arrays, starts, strict=True)
            ]
        ).astype(np.int32),
        right=np.concatenate(
            [
                np.maximum(tree.children_right, 0) + at
                for tree, at in zip(arrays, starts, strict=True)
            ]
        ).astype(np.int32),
        value=np.concatenate([tree.value[:, 0, 1] for tree in arrays]).astype(np.float32),
    )
    print(f"{FILE}: {FILE.stat().st_size / 1e3:.0f} kB, {len(shapes)} shapes")


if __name__ == "__main__":
    typer.run(main)
