"""What a translation did with each keyword."""
from ..meshes.model import MeshError


class Notes:
    """ignored: keywords that -deck_ignore names"""

    def __init__(self, ignored):
        self.ignored = {word.strip().upper().lstrip("*") for words in ignored for word in words.split(",")}
        self.used, self.translated, self.approximated, self.refused, self.omitted = set(), {}, [], [], []

    def translate(self, keyword, where):
        self.translated.setdefault(keyword, []).append(line(where))

    def approximate(self, keyword, where, text):
        self.approximated.append((keyword, line(where), text))

    def refuse(self, keyword, where, text):
        """Refuses a keyword unless -deck_ignore names it"""
        if keyword in self.ignored:
            self.used.add(keyword)
            self.omitted.append((keyword, line(where), text))
        else:
            self.refused.append((keyword, where, text))

    def check(self, path):
        if self.refused:
            more = f" ({len(self.refused)} keywords are not translated)" if len(self.refused) > 1 else ""
            keyword, where, text = self.refused[0]
            raise MeshError(
                f"{where}: *{keyword}: {text}{more}. To leave it out: contact-mesh DECK.inp -scene SCENE.yaml "
                f"-deck_ignore \"{keyword}\"")

    def check_ignored(self, path):
        """To be called last: all keywords that -deck_ignore names must have been left out"""
        unused = sorted(self.ignored - self.used)
        if unused:
            raise MeshError(f"{path}: -deck_ignore {unused[0]}: the deck has no such keyword that is not translated")

    def lines(self):
        """Lines for the heading of the scene"""
        for title, entries in (("approximated", self.approximated), ("left out, by -deck_ignore", self.omitted)):
            if entries:
                yield title + ":"
                yield from (f"  *{keyword}, {place}: {text}" for keyword, place, text in entries)
        yield "translated:"
        yield from (f"  *{keyword}, {places(lines)}" for keyword, lines in self.translated.items())


def line(where):
    """'line 5' of 'FILE, line 5'"""
    return where.rsplit(", ", 1)[-1]


def places(lines):
    shown = ", ".join(lines[:6])
    return shown + (f" and {len(lines) - 6} more" if len(lines) > 6 else "")
