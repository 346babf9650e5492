# Sphinx configuration of the documentation site; scripts/docs says what the source folder is.
import pathlib
import re
import sys

source = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(source / "docs/site"))

project = "musim"
author = "the authors of musim"
copyright = "the authors of musim, Apache License 2.0"
release = re.search(r"project\(musim VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "subscripts"]
root_doc = "README"
exclude_patterns = ["docs/site"]
myst_heading_anchors = 4
nitpicky = True
highlight_language = "text"
smartquotes = False  # what is in a command or a file stays as it is typed

html_theme = "furo"
html_title = f"musim {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
templates_path = ["templates"]
html_sidebars = {"**": ["sidebar/scroll-start.html", "sidebar/brand.html", "sidebar/search.html", "sidebar/navigation.html",
                        "sidebar/cpp_reference.html", "sidebar/scroll-end.html"]}
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False
html_show_search_summary = False  # a browser reads no second file from file://
