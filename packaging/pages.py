#!/usr/bin/python3
"""packaging/pages.py RELUME OUT: man pages and shell completion, made from what the command itself says.

Reads `relume help` and every verb's --help; nothing here knows a verb or an option by name. Writes

    OUT/man/relume.1, OUT/man/relume-VERB.1
    OUT/bash/relume, OUT/zsh/_relume, OUT/fish/relume.fish

Same help texts, same bytes: no date but the one of SOURCE_DATE_EPOCH, where it is set.
"""
import datetime
import os
import pathlib
import re
import subprocess
import sys

OPTION = re.compile(r"^ {2,6}(?:-(?P<short>\w), )?--(?P<long>[a-z][\w-]*)(?: (?P<value>[A-Z][^ ]*))?(?: +(?P<text>.*))?$")
VERB = re.compile(r"^  (\w+) +(.+)$", re.M)
FILES = re.compile(r"TRACE|FILE|DIR|PATTERN|\.\w+|REF|PATH|FOLDER")


class Help:
    """A help text in parts: usage lines, then blocks: ("text", lines) or ("options", [option])."""

    def __init__(self, text):
        lines = text.rstrip("\n").split("\n")
        end = lines.index("") if "" in lines else len(lines)
        self.usage = [re.sub(r"^(usage: )? *", "", line) for line in lines[:end]]
        self.blocks = []
        self.options = []
        for line in lines[end + 1:] + [""]:
            found = OPTION.match(line)
            kind = self.blocks[-1][0] if self.blocks else None
            if found:
                option = {**found.groupdict(), "text": [found["text"] or ""]}
                self.options.append(option)
                if kind != "options":
                    self.blocks.append(("options", []))
                self.blocks[-1][1].append(option)
            elif kind == "options" and re.match(r" {8,}\S", line):
                self.blocks[-1][1][-1]["text"].append(line.strip())
            elif not line:
                self.blocks.append(("text", []))
            else:
                if kind != "text":
                    self.blocks.append(("text", []))
                self.blocks[-1][1].append(line)
        self.blocks = [b for b in self.blocks if b[1]]



def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text[:1] in ".'" else text


def page(name, about, help, others):
    day = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", 0)), datetime.timezone.utc)
    out = [f'.TH {name.upper()} 1 "{day:%Y-%m-%d}" relume "User Commands"', ".SH NAME", f"{roff(name)} \\- {roff(about)}",
           ".SH SYNOPSIS"]
    for line in help.usage:
        out += [".nf", f"\\fB{roff(line.split()[0])}\\fR {roff(' '.join(line.split()[1:]))}", ".fi"]
    out.append(".SH DESCRIPTION")
    heading = "DESCRIPTION"
    for i, (kind, lines) in enumerate(help.blocks):
        is_title = kind == "text" and len(lines) == 1 and lines[0].endswith(":") and help.blocks[i + 1:i + 2] and \
            help.blocks[i + 1][0] == "options"
        if kind == "options" or is_title:
            if heading != "OPTIONS":
                out.append(".SH OPTIONS")
                heading = "OPTIONS"
            if is_title:
                out.append(f".SS {roff(lines[0].rstrip(':'))}")
                continue
            for option in lines:
                names = [f"\\fB\\-{option['short']}\\fR"] if option["short"] else []
                value = f" \\fI{roff(option['value'])}\\fR" if option["value"] else ""
                names.append(f"\\fB\\-\\-{roff(option['long'])}\\fR{value}")
                out += [".TP", ", ".join(names), *(roff(t) for t in option["text"])]
            continue
        if lines[0].startswith("Exit") and heading != "EXIT STATUS":
            out.append(".SH EXIT STATUS")
            heading = "EXIT STATUS"
        elif heading == "OPTIONS":
            out.append(".SH NOTES")
            heading = "NOTES"
        # Columns are kept as they stand; running text is set anew.
        columns = any(re.search(r"^ |\S {2,}\S", line) for line in lines)
        out += [".PP", *([".nf"] if columns else []), *(roff(line) for line in lines), *([".fi"] if columns else [])]
    out += [".SH SEE ALSO", ",\n".join(f".BR {roff(o)} (1)" for o in others).replace(",\n.BR", " ,\n.BR")]
    return "\n".join(out) + "\n"


def takes_file(value):
    return bool(value) and bool(FILES.search(value))


def names_of(option):
    return [f"-{option['short']}"] * bool(option["short"]) + [f"--{option['long']}"]


def quote(text):
    return "'" + text.replace("'", "'\\''") + "'"


def short_text(option):
    return re.split(r"[;:(]|, ", " ".join(option["text"]))[0].strip()


def bash(verbs):
    cases, files, values = [], [], []
    for verb, (_, help) in verbs.items():
        words = " ".join(n for o in help.options for n in names_of(o))
        cases.append(f"\t{verb}) words={quote(words)} ;;")
        for option in help.options:
            if option["value"]:
                (files if takes_file(option["value"]) else values).extend(f"{verb}:{n}" for n in names_of(option))
    return f"""# bash completion of relume, made from its help texts.
_relume()
{{
	local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} verb=${{COMP_WORDS[1]}} words=
	COMPREPLY=()
	if [ "$COMP_CWORD" = 1 ] || [ "$verb" = help ]; then
		mapfile -t COMPREPLY < <(compgen -W '{" ".join(verbs)} help' -- "$cur")
		return
	fi
	case "$verb:$prev" in
	{"|".join(values)}) return ;;
	{"|".join(files)}) mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
	esac
	case "$verb" in
{chr(10).join(cases)}
	esac
	if [ "${{cur#-}}" != "$cur" ]; then
		mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
	else
		mapfile -t COMPREPLY < <(compgen -f -- "$cur")
	fi
}}
complete -o filenames -F _relume relume
"""


def zsh(verbs):
    def clean(text):
        return re.sub(r"([\[\]:\\])", r"\\\1", text)

    cases = []
    for verb, (_, help) in verbs.items():
        specs = []
        for option in help.options:
            action = f":{clean(option['value'])}:{'_files' if takes_file(option['value']) else ' '}" if option["value"] else ""
            for name in names_of(option):
                specs.append(quote(f"*{name}[{clean(short_text(option))}]{action}"))
        cases.append(f"\t{verb}) _arguments -s {' '.join(specs)} '*:file:_files' ;;")
    listed = " ".join(quote(f"{verb}:{clean(about)}") for verb, (about, _) in verbs.items())
    return f"""#compdef relume
# zsh completion of relume, made from its help texts.
_relume()
{{
	local -a verbs=({listed} 'help:explain a verb')
	if (( CURRENT == 2 )) || {{ [[ $words[2] = help ]] && (( CURRENT == 3 )) }}; then
		_describe verb verbs
		return
	fi
	local verb=$words[2]
	shift words
	(( CURRENT-- ))
	case $verb in
{chr(10).join(cases)}
	esac
}}
_relume "$@"
"""


def fish(verbs):
    def text(t):
        return "'" + t.replace("\\", "\\\\").replace("'", "\\'") + "'"

    lines = ["# fish completion of relume, made from its help texts.", "complete -c relume -f"]
    for verb, (about, help) in {**verbs, "help": ("explain a verb", None)}.items():
        lines.append(f"complete -c relume -n __fish_use_subcommand -a {verb} -d {text(about)}")
        if not help:
            lines.append(f"complete -c relume -n '__fish_seen_subcommand_from help' -a {text(' '.join(verbs))}")
            continue
        seen = f"-n '__fish_seen_subcommand_from {verb}'"
        lines.append(f"complete -c relume {seen} -F")
        for option in help.options:
            short = f" -s {option['short']}" if option["short"] else ""
            value = "" if not option["value"] else " -r -F" if takes_file(option["value"]) else " -x"
            lines.append(f"complete -c relume {seen}{short} -l {option['long']}{value} -d {text(short_text(option))}")
    return "\n".join(lines) + "\n"


def main(relume, out):
    def ask(*words):
        return subprocess.run([relume, *words], stdout=subprocess.PIPE, text=True, check=True).stdout

    overview = ask("help")
    verbs = {verb: (about, Help(ask(verb, "--help"))) for verb, about in VERB.findall(overview) if verb != "help"}
    if not verbs or not all(h.usage for _, h in verbs.values()):
        sys.exit("pages.py: the help text lists no verbs, or a verb says no usage")
    pages = [f"relume-{v}" for v in verbs]
    files = {"man/relume.1": page("relume", "ray trace what a legacy OpenGL program draws, from a recording", Help(overview),
                                  pages)}
    for verb, (about, help) in verbs.items():
        files[f"man/relume-{verb}.1"] = page(f"relume-{verb}", about, help, ["relume", *(p for p in pages if p[7:] != verb)])
    files.update({"bash/relume": bash(verbs), "zsh/_relume": zsh(verbs), "fish/relume.fish": fish(verbs)})
    for name, content in files.items():
        path = pathlib.Path(out, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
