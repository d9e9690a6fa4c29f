"""The frame of every page: its head, and its style, in the page or beside it."""

from html import escape

FRAME = """<!DOCTYPE html>
<html lang="en-GB">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{title}</title>
<link rel="icon" href="data:,">
{style}
</head>
<body class="{kind}">
{body}
</body>
</html>
"""


def framed(title: str, body: str, kind: str, style: str) -> str:
    """Return a page; `kind` is its class in paper/site/site.css, `style` an element of the head."""
    return FRAME.format(title=escape(title), style=style, kind=kind, body=body)
