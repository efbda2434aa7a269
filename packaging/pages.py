#!/usr/bin/python3
"""packaging/pages.py RELUME OUT: man pages and shell completion, made from the command's help texts.

Reads `relume help` and every verb's --help; nothing here knows a verb or an option by name. Pages about formats of
files come from the same texts as `relume help NAME-file` (manual.py). Writes

    OUT/man/relume.1, OUT/man/relume-VERB.1, OUT/man/relume-NAME.5
    OUT/bash/relume, OUT/zsh/_relume, OUT/fish/relume.fish

Same texts, same bytes: the date is SOURCE_DATE_EPOCH's, else that of the newest entry of Debian's changelog.
"""
import datetime
import email.utils
import os
import pathlib
import re
import subprocess
import sys

import manual

OPTION = re.compile(
    r"^ {2,6}(?:-(?P<short>\w), )?--(?P<long>[a-z][\w-]*)(?: (?P<value>[A-Z][^ ]*))?(?: +(?P<text>.*))?$")
VERB = re.compile(r"^  (\w+) +(.+)$", re.M)
FILES = re.compile(r"TRACE|FILE|DIR|PATTERN|\.\w+|REF|PATH|FOLDER")


class Help:
    """The parts of a help text: usage lines, then blocks: ("text", lines) or ("options", [option])."""

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
    text = text.replace("\\",
                        "\\e").replace("-",
                                       "\\-").replace("'",
                                                      "\\(aq").replace("`",
                                                                       "\\(ga").replace("^",
                                                                                        "\\(ha").replace("~", "\\(ti")
    return "\\&" + text if text.startswith(".") else text


def day():
    if "SOURCE_DATE_EPOCH" in os.environ:
        return datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    log = (manual.ROOT / "packaging/debian/changelog").read_text()
    return email.utils.parsedate_to_datetime(re.search(r"^ -- .*>  (.*)$", log, re.M)[1])


def page(name, section, about, body, others):
    """@param others  names of other pages, with their sections, as in "relume(1)"."""
    group = {1: "User Commands", 5: "File Formats"}[section]
    see = " ,\n".join(".BR \\%{} ({})".format(*re.fullmatch(r"(.*)\((\d)\)", roff(other)).groups()) for other in others)
    body = [line for before, line in zip([None, *body], body) if line != ".PP" or not before.startswith((".SH", ".SS"))]
    return "\n".join([
        f'.TH {name.upper()} {section} "{day():%Y-%m-%d}" relume "{group}"', ".SH NAME",
        f"{roff(name)} \\- {roff(about)}", *body, ".SH SEE ALSO", see
    ]) + "\n"


def as_typed(lines):
    """Lines to print unchanged."""
    return [".PP", ".RS 4", ".nf", *(roff(line) for line in lines), ".fi", ".RE"]


def examples_of(lines):
    """Examples of a help text: "# ..." describes the commands below it."""
    out, commands = [], []
    for line in [*(line.strip() for line in lines), "# "]:
        if line.startswith("# "):
            out += as_typed(commands) if commands else []
            out += [".PP", roff(line[2:] + ("" if line[-1] in "?)" else ":"))] if line != "# " else []
            commands = []
        else:
            commands.append(line)
    return out


def option_of(option):
    names = [f"\\fB\\-{option['short']}\\fR"] if option["short"] else []
    value = f" \\fI{roff(option['value'])}\\fR" if option["value"] else ""
    names.append(f"\\fB\\-\\-{roff(option['long'])}\\fR{value}")
    return [".TP", ", ".join(names), *(roff(t) for t in option["text"])]


def body_of_help(help):
    out = [".SH SYNOPSIS"]
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
                out += option_of(option)
            continue
        if lines[0] == "Examples:":
            out += [".SH EXAMPLES", *examples_of(lines[1:])]
            continue
        if lines[0].startswith("Exit") and heading != "EXIT STATUS":
            out.append(".SH EXIT STATUS")
            heading = "EXIT STATUS"
        elif heading == "OPTIONS":
            out.append(".SH NOTES")
            heading = "NOTES"
        # Columns are kept unchanged; running text is refilled.
        columns = any(re.search(r"^ |\S {2,}\S", line) for line in lines)
        out += [".PP", *([".nf"] if columns else []), *(roff(line) for line in lines), *([".fi"] if columns else [])]
    return out


def keys_of(lines):
    """Keys of a file with their meanings; keys within a key follow it, indented."""
    out, depths = [], [0]
    for line in lines:
        code, _, text = re.fullmatch(r"(.*?)(\s*# (.*))?", line).groups()
        if not code.strip():  # continues the key above
            out.append(roff(text))
            continue
        depth = len(code) - len(code.lstrip())
        while depth < depths[-1]:
            out.append(".RE")
            depths.pop()
        if depth > depths[-1]:
            out.append(".RS 4")
            depths.append(depth)
        out += [".TP", f"\\fB{roff(code.strip())}\\fR", *([roff(text)] if text else [])]
    return out + [".RE"] * (len(depths) - 1)


def body_of_format(blocks):
    out = [".SH DESCRIPTION"]
    for kind, content in blocks:
        if kind == "heading":
            out.append(f".SH {roff(content)}")
        elif kind == "text":
            out += [".PP", roff(content)]
        elif kind == "list":
            for term, words in content:
                out += [".TP", f"\\fB{roff(term)}\\fR", roff(words)]
        else:
            out += keys_of(content) if kind == "keys" else as_typed(content)
    return out


def formats():
    return {f"{form.name}-file": form.summary for form in manual.FORMATS}


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
	if [ "$COMP_CWORD" = 1 ]; then
		mapfile -t COMPREPLY < <(compgen -W '{" ".join(verbs)} help' -- "$cur")
		return
	fi
	if [ "$verb" = help ]; then
		mapfile -t COMPREPLY < <(compgen -W '{" ".join([*verbs, *formats()])} help' -- "$cur")
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
            action = f":{clean(option['value'])}:{'_files' if takes_file(option['value']) else ' '}" if option[
                "value"] else ""
            for name in names_of(option):
                specs.append(quote(f"*{name}[{clean(short_text(option))}]{action}"))
        cases.append(f"\t{verb}) _arguments -s {' '.join(specs)} '*:file:_files' ;;")
    listed = " ".join(quote(f"{verb}:{clean(about)}") for verb, (about, _) in verbs.items())
    formats_listed = " ".join(quote(f"{name}:{clean(summary)}") for name, summary in formats().items())
    return f"""#compdef relume
# zsh completion of relume, made from its help texts.
_relume()
{{
	local -a verbs=({listed} 'help:explain a verb')
	local -a formats=({formats_listed})
	if (( CURRENT == 2 )); then
		_describe verb verbs
		return
	fi
	if [[ $words[2] = help ]] && (( CURRENT == 3 )); then
		_describe verb verbs -- formats
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
            lines.append(
                f"complete -c relume -n '__fish_seen_subcommand_from help' -a {text(' '.join([*verbs, *formats()]))}")
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
    pages = {verb: f"relume-{verb}(1)" for verb in verbs}
    file_pages = {form.name: f"relume-{form.name}(5)" for form in manual.FORMATS}
    about = "ray trace what a legacy OpenGL program draws, from a recording"
    files = {
        "man/relume.1": page("relume", 1, about, body_of_help(Help(overview)), [*pages.values(), *file_pages.values()])
    }
    texts = {verb: ask("help", verb) for verb in verbs}
    for verb, (about, help) in verbs.items():
        others = [p for v, p in pages.items() if v != verb
                  ] + [p for name, p in file_pages.items() if f"{name}-file" in texts[verb]]
        files[f"man/relume-{verb}.1"] = page(f"relume-{verb}", 1, about, body_of_help(help), ["relume(1)", *others])
    for form in manual.FORMATS:
        others = ["relume(1)", *(pages[verb] for verb in verbs if f"{form.name}-file" in texts[verb])]
        files[f"man/relume-{form.name}.5"] = page(f"relume-{form.name}", 5, form.summary,
                                                  body_of_format(manual.read(form.source)), others)
    files.update({"bash/relume": bash(verbs), "zsh/_relume": zsh(verbs), "fish/relume.fish": fish(verbs)})
    for name, content in files.items():
        path = pathlib.Path(out, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
