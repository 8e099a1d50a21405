#!/usr/bin/env python3
"""The structure check on small trees that are made up: each breach is found, and what is clean passes."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from rules import all_findings, read_layers, strays
from sources import defined_types, read

LAYERS = """
[.]
core
vascular device  # neither knows the other
app
tests
[core]
math
rod
[tests]
core
[tables]
core/math/table.cpp
"""


def findings(files, layers_text=LAYERS):
    """Of a tree of these files {path: text}: (path, line, what)."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in {**files, "layers.txt": layers_text}.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        layers, tables, _ = read_layers(os.path.join(root, "layers.txt"))
        return [(f.path, f.line, f.what) for f in all_findings(read(root), layers, tables)]


class Structure(unittest.TestCase):
    def test_what_has_strayed_to_the_top_is_named(self):
        names = ["core", "README.md", ".git", "build", "build-asan", "report.html", "out", "__pycache__", "notes"]
        found = strays(names, ["/build/", "/build-*/", "/out/", "__pycache__/"], {"core", "README.md"})
        self.assertEqual([f.path for f in found], ["notes", "report.html"])

    def test_a_clean_tree_passes(self):
        self.assertEqual(findings({
            "core/math/field.h": "#include <vector>\nnamespace ostium {\nstruct Field { int n; };\n}\n",
            "core/rod/rod.h": '#include "core/math/field.h"\nnamespace ostium {\nstruct Field;\nstruct Rod {};\n}\n',
            "core/math/table.cpp": "int a;\n" * 500,
            "tests/core/rod_test.cpp": '#include "core/rod/rod.h"\nnamespace { struct Rod {}; }\n',
        }), [])

    def test_a_ring_is_told_with_its_includes(self):
        (path, line, what), = findings({
            "core/rod/a.h": '\n#include "core/rod/inner/b.h"\n',
            "core/rod/inner/b.h": '#include "core/rod/c.h"\n',
            "core/rod/c.h": "",
        })
        self.assertEqual((path, line), ("core/rod/a.h", 2))
        self.assertIn("core/rod, core/rod/inner", what)
        self.assertIn('core/rod/inner/b.h:1 includes "core/rod/c.h"', what)

    def test_arrows_up_and_sideways(self):
        found = findings({
            "core/math/field.h": '#include "core/rod/rod.h"\n',
            "core/rod/rod.h": "",
            "device/box.h": '// none\n#include "vascular/wall.h"\n',
            "vascular/wall.h": "",
        })
        self.assertEqual([(path, line) for path, line, _ in found], [("core/math/field.h", 1), ("device/box.h", 2)])
        self.assertIn("goes up: math may not include rod of core", found[0][2])
        self.assertIn("goes sideways: device may not include vascular", found[1][2])

    def test_a_test_includes_what_its_library_may(self):
        (path, _, what), = findings({
            "tests/core/rod_test.cpp": '#include "app/gates.h"\n#include "core/math/field.h"\n',
            "app/gates.h": "", "core/math/field.h": "",
        })
        self.assertEqual(path, "tests/core/rod_test.cpp")
        self.assertIn("core may not include app", what)

    def test_a_comment_names_files_that_are_there(self):
        (path, line, what), = findings({"core/rod/rod.h": "int a;  // core/rod/rod.h, core/rod/gone.h\n"})
        self.assertEqual((path, line), ("core/rod/rod.h", 1))
        self.assertIn("names core/rod/gone.h", what)

    def test_twins(self):
        found = findings({
            "core/rod/a.cpp": "namespace ostium {\nclass View {\n};\n}\n",
            "app/b.h": "namespace ostium {\n\nstruct View final : Base {\n};\nnamespace { enum class Own : int { x }; }\n}\n",
            "app/c.h": "namespace ostium::app { struct View {}; }\nnamespace ostium { namespace { struct Own {}; } }\n",
            "app/d.cpp": "namespace ostium { namespace { struct View {}; struct Own {}; } }\n",
        })
        self.assertEqual([(path, line) for path, line, _ in found], [("app/b.h", 5), ("app/b.h", 3)])
        self.assertIn("ostium::Own is defined here and in app/c.h:2", found[0][2])
        self.assertIn("ostium::View is defined here and in core/rod/a.cpp:2", found[1][2])

    def test_long_files_and_folders_without_a_place(self):
        found = findings({"core/math/long.cpp": "int a;\n" * 401, "core/attic/a.h": "", "core/loose.h": ""})
        self.assertEqual([path for path, _, _ in found], ["core/attic/a.h", "core/loose.h", "core/math/long.cpp"])


class Types(unittest.TestCase):
    def names(self, text):
        return [t.name for t in defined_types(text)]

    def test_what_defines_a_type(self):
        self.assertEqual(self.names("struct A { enum class B { x }; }; template <class T> struct C : D<T> { T f() { "
                                    "struct Local {}; return {}; } };"), ["A", "A::B", "C"])

    def test_what_does_not(self):
        self.assertEqual(self.names('struct A; enum class B : int; A f(struct C c) { return {}; }\n'
                                    '// struct D {\n/* struct E { */ const char* s = "struct F {"; char c = \'{\';\n'
                                    'template <> struct G<int> {};\nint n = 100\'000;\n#define H struct I {\n'), [])


if __name__ == "__main__":
    unittest.main()
