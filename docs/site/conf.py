"""Settings of Sphinx for the site that scripts/docs builds. Everything it needs is on the disk: a page makes no request
to another host."""

project = "whirl_twin"
author = copyright = "the whirl_twin authors"
extensions = ["myst_parser", "sphinx_copybutton"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
html_theme = "furo"
html_title = "whirl_twin"
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}
html_static_path = ["static"]
html_css_files = ["wide.css"]

# The anchors of headings that GitHub makes, so that one link serves both.
myst_heading_anchors = 4
# Output that a page shows, and grammars that Pygments does not know.
highlight_language = "none"
copybutton_prompt_text = "$ "
suppress_warnings = ["myst.header"]
