#!/usr/bin/env python3
"""What compare tells of two small results, and what it passes over."""
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from differences import differences
from programs import parsed


def told(old, new):
    return [str(d) for d in differences(parsed(old), parsed(new))]


class Comparison(unittest.TestCase):
    def test_the_same_is_the_same(self):
        self.assertEqual(told('{"a": [1, 2.50, null, {"b": "x"}]}', '{"a": [1, 2.50, null, {"b": "x"}]}'), [])

    def test_the_last_digit_counts(self):
        self.assertEqual(told('{"a": [{"v": 0.12345678901234567}]}', '{"a": [{"v": 0.12345678901234568}]}'),
                         ["a[0].v: 0.12345678901234567 -> 0.12345678901234568"])
        self.assertEqual(told('{"a": 1}', '{"a": 1.0}'), ["a: 1 -> 1.0"])

    def test_what_is_missing_or_more(self):
        self.assertEqual(told('{"a": 1, "b": [1]}', '{"c": 1, "b": [1, 2]}'),
                         ["a: 1 -> (missing)", "b[1]: (missing) -> 2", "c: (missing) -> 1"])

    def test_times_are_passed_over_and_hashes_only_told(self):
        found = differences(parsed('{"step_ms": {"mean": 0.5}, "hash": "0a"}'), parsed('{"step_ms": 3, "hash": "0b"}'))
        self.assertEqual([str(d) for d in found], ["state hash hash: 0a -> 0b"])
        self.assertTrue(found[0].is_hash)
        self.assertFalse(differences({"hash": "0a"}, {})[0].is_hash)

    def test_tables(self):
        a, b = "# sweep\nseed,depth,hash\n1,0.5,aa\n", "# other\nseed,depth,hash\n1,0.6,bb\n"
        found = differences(parsed(a, "t.csv"), parsed(b, "t.csv"))
        self.assertEqual([str(d) for d in found], ["[0].depth: 0.5 -> 0.6", "state hash [0].hash: aa -> bb"])


if __name__ == "__main__":
    unittest.main()
