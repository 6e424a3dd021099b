# SPDX-License-Identifier: MIT
"""Pairs a batch at a time."""

import gc
import resource
import threading

import allpairs
import numpy as np
import pytest
from conftest import every_pair, random_boxes


@pytest.mark.parametrize("size", [1, 7, 100, 10**6])
@pytest.mark.parametrize("order", ["first", "second", "unordered"])
def test_batches_are_the_pairs_one_after_the_other(size, order, boxes):
    batches = list(allpairs.batches(*boxes, batch_size=size, order=order))
    assert all(0 < len(batch) <= size for batch in batches)
    np.testing.assert_array_equal(np.vstack(batches), allpairs.overlaps(*boxes, order=order))


def test_batches_between_two_sets(boxes):
    others = random_boxes(90, seed=2)
    batches = list(allpairs.batches_between(boxes, others, batch_size=11, distance=1))
    np.testing.assert_array_equal(np.vstack(batches), allpairs.overlaps_between(boxes, others, distance=1))


def test_no_pairs_are_no_batches():
    assert list(allpairs.batches([], [])) == []


def test_leaving_early_ends_the_search():
    before = threading.active_count()
    for batch in allpairs.batches(np.zeros((3000, 6)), batch_size=10):
        assert batch[:2].tolist() == [[0, 1], [0, 2]]
        break
    stream = allpairs.batches(np.zeros((3000, 6)), batch_size=10)
    next(stream)
    stream.close()
    assert list(stream) == []
    unread = allpairs.batches(np.zeros((3000, 6)))
    del unread
    gc.collect()
    assert threading.active_count() == before


def test_the_boxes_live_as_long_as_the_batches():
    stream = allpairs.batches(*(corner.copy() for corner in random_boxes(400)), batch_size=5)
    gc.collect()
    np.testing.assert_array_equal(np.vstack(list(stream)), every_pair(*random_boxes(400)))


def test_bad_arguments_are_raised_at_once():
    with pytest.raises(allpairs.InvalidBox):
        allpairs.batches(np.full((1, 6), np.nan))
    with pytest.raises(allpairs.InvalidArgument, match="batch_size is 0"):
        allpairs.batches(np.zeros((1, 6)), batch_size=0)


def test_what_the_search_raises_is_raised_to_the_reader_once():
    stream = allpairs.batches(np.zeros((2, 6)), distance=float("nan"))
    with pytest.raises(allpairs.InvalidArgument, match="distance"):
        next(stream)
    assert list(stream) == []


@pytest.mark.parametrize("order", ["first", "second", "unordered"])
def test_more_pairs_than_allowed_are_raised_in_place_of_the_rest(order, boxes):
    others = random_boxes(90, seed=2)
    for batches, pairs in (
        (lambda limit: allpairs.batches(*boxes, order=order, batch_size=7, max_pairs=limit), allpairs.overlaps(*boxes, order=order)),
        (
            lambda limit: allpairs.batches_between(boxes, others, order=order, batch_size=7, max_pairs=limit),
            allpairs.overlaps_between(boxes, others, order=order),
        ),
    ):
        np.testing.assert_array_equal(np.vstack(list(batches(len(pairs)))), pairs)
        found = [pairs[:0]]
        with pytest.raises(allpairs.LimitExceeded) as caught:
            for batch in batches(len(pairs) - 1):
                found.append(batch)
        assert caught.value.count == len(pairs)
        received = np.vstack(found)
        assert len(received) < len(pairs)
        np.testing.assert_array_equal(received, pairs[: len(received)])


def test_memory_does_not_grow_with_the_pairs():
    boxes = np.zeros((9000, 6), dtype=np.float32)  # 40 million pairs, 320 MB
    list(allpairs.batches(boxes[:4500]))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert sum(len(batch) for batch in allpairs.batches(boxes)) == 9000 * 8999 // 2
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 100_000  # kilobytes


def test_searches_in_several_threads_do_not_meet(boxes):
    expected = every_pair(*boxes)
    failures = []

    def work():
        for _ in range(20):
            found = np.vstack(list(allpairs.batches(*boxes, batch_size=50)))
            if not (np.array_equal(found, expected) and np.array_equal(allpairs.overlaps(*boxes), expected)):
                failures.append(found)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
