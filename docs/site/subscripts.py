"""Sets symbols such as λ_l and μ^N of plain text with subscripts and superscripts; what stands as code stays as it is typed."""
import re

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

SYMBOL = re.compile(r"""(?<![\w`]) (?P<base>[^\W\d_]) _ (?: (?P<sub>[^\W_²³]{1,8}(?:,[a-z])?) (?![^\W²³]) | \{(?P<index>[^{}\s]{1,8})\} )
                        | (?<=[\w)]) \^ (?: \((?P<group>[^()\s]{1,12})\) | (?P<power>[−-]?[^\W_]{1,3}) (?!\w) )""", re.VERBOSE)


class Subscripts(SphinxPostTransform):
    default_priority = 400

    def run(self, **kwargs):
        for text in list(self.document.findall(nodes.Text)):
            parent = text.parent
            if isinstance(parent, (nodes.literal, nodes.literal_block, nodes.raw, nodes.comment, nodes.title)):
                continue
            pieces, end = [], 0
            for match in SYMBOL.finditer(text):
                pieces.append(nodes.Text(text[end:match.start()] + (match["base"] or "")))
                raised, lowered = match["group"] or match["power"], match["sub"] or match["index"]
                pieces.append(nodes.superscript("", raised) if raised else nodes.subscript("", lowered))
                end = match.end()
            if pieces:
                parent.replace(text, pieces + [nodes.Text(text[end:])])


def setup(app):
    app.add_post_transform(Subscripts)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
