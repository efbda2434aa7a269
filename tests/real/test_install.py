#!/usr/bin/python3
"""make install into a folder: the installed command runs from there, its documentation and files are found; uninstall
leaves nothing."""
import os
import pathlib
import re
import shutil
import subprocess

import yaml

from helpers import BUILD, ROOT, SCRATCH, check, finish, must, on_display, run

PLACE = SCRATCH / "place"
PREFIX = PLACE / "usr"


def make(target, *options):
    return run("make", "-C", ROOT, "--no-print-directory", *options, target, f"BUILD={os.path.relpath(BUILD, ROOT)}",
               "PREFIX=/usr", f"DESTDIR={PLACE}")


# Other tests use the build while this one runs, so nothing may be rebuilt. A second `make` has nothing to do.
for target in "all", "pages":
    again = make(target, "-n").stdout
    if not check("Nothing to be done" in again, f"make {target} would build again: {again[:1000]}"):
        finish()
# On a bare machine the first line is ours: without a compiler or other programs, make prints nothing before it.
tools = SCRATCH / "tools"
tools.mkdir()
for name in "make", "sh":
    (tools / name).symlink_to(shutil.which(name))
bare = run("make", "-C", ROOT, "--no-print-directory", "-n", "demo", f"BUILD={SCRATCH / 'bare'}",
           env={"PATH": str(tools)})
check(
    bare.stdout.startswith("corpus/demo.sh ") and not bare.stderr,
    f"make demo on a bare machine says {bare.stdout}{bare.stderr}")
must(make("install"))
relume = PREFIX / "bin/relume"
version = (ROOT / "VERSION").read_text().strip()

# It runs from there, and finds its own recorder, not that of the build.
done = must(on_display(relume, "record", "-o", SCRATCH / "gears.trace", "--quit-after", "3", "--", "glxgears"))
check("3 frames" in done.stderr, f"the installed command records: {done.stderr}")
maps = run(relume, "record", "-o", SCRATCH / "cat.trace", "--", "cat", "/proc/self/maps").stdout
found = set(re.findall(r"/\S.*librelume\.so", maps))
with_i386 = (BUILD / "lib/i386-linux-gnu/librelume.so").exists()
recorders = {
    bits: PREFIX / "lib/relume" / (f"lib/{bits}-linux-gnu" if with_i386 else "") / "librelume.so"
    for bits in ("x86_64", "i386")
}
check(found == {str(recorders["x86_64"])}, f"its recorder is the installed one: {found}")
if with_i386:
    check(recorders["i386"].read_bytes()[4] == 1,
          "the recorder for programs of 32 bits is installed, and is a 32-bit library")
    done = must(
        on_display(relume, "record", "-o", SCRATCH / "i386.trace", "--", BUILD / "i386/two_triangles", "--frames", "3"))
    check("3 frames" in done.stderr and "preloaded" not in done.stderr,
          f"the installed command records a 32-bit program: {done.stderr}")
else:
    check(not (PREFIX / "lib/relume/lib").exists(), "no folder for two recorders if there is only one")
must(run(relume, "render", SCRATCH / "gears.trace", "-f", "2", "-o", SCRATCH / "gears.####.exr"))
check((SCRATCH / "gears.0002.exr").exists(), "the installed command renders")
done = run(relume, "diff", "--report", SCRATCH / "report", SCRATCH / "gears.0002.exr", SCRATCH / "gears.0002.exr")
check(done.returncode == 0 and (SCRATCH / "report/sheet.png").exists(),
      f"the installed command scores, with pictures: {done.returncode}, {done.stderr}")

check((PREFIX / "share/relume/score.schema.json").read_bytes() == (ROOT / "diff/score/score.schema.json").read_bytes(),
      "the schema of scores is installed")

# A path that the dynamic linker cannot preload is reported, not ignored.
spaced = SCRATCH / "a place"
shutil.copytree(PREFIX, spaced)
done = run(spaced / "bin/relume", "record", "-o", SCRATCH / "none.trace", "--", "true")
check(done.returncode == 5 and "cannot be preloaded" in done.stderr,
      f"a path with a space: {done.returncode}, {done.stderr}")

# The header, through pkg-config.
env = dict(os.environ, PKG_CONFIG_PATH=str(PREFIX / "share/pkgconfig"))
check(run("pkg-config", "--modversion", "relume", env=env).stdout.strip() == version, "pkg-config knows the version")
flags = run("pkg-config", f"--define-variable=prefix={PREFIX}", "--cflags", "relume", env=env).stdout
include = flags.strip().removeprefix("-I").replace("\\ ", " ")
program = SCRATCH / "mirror.c"
program.write_text("#include <relume.h>\nint main(void) { rtMaterialEXT(RT_MIRROR_EXT, 0.5f, 1); return 0; }\n")
must(run("cc", "-I", include, "-o", SCRATCH / "mirror", program))
check(run(SCRATCH / "mirror").returncode == 0, "a program with the header runs without a recorder")

# A page for every verb that describes every option of its help text; no complaint from the formatter.
verbs = re.findall(r"^  (\w+) ", run(relume, "help").stdout, re.M)
options = {v: set(re.findall(r"^ {2,6}(?:-\w, )?(--[a-z][\w-]*)", run(relume, "help", v).stdout, re.M))
           for v in verbs if v != "help"}
for verb, known in options.items():
    source = PREFIX / f"share/man/man1/relume-{verb}.1"
    page = run("man", "--warnings", "-P", "cat", "-l", source, env=dict(os.environ, MANWIDTH="300", LC_ALL="C.UTF-8"))
    check(page.returncode == 0 and not page.stderr, f"man relume-{verb}: {page.stderr}")
    text = re.sub(r".\x08", "", page.stdout)
    check(all(o in text for o in known), f"man relume-{verb} describes every option: {known - set(text.split())}")
# A page about each file format, and in every page a date and examples.
formats = re.findall(r"^  (\w+)-file ", run(relume, "help").stdout, re.M)
pages = sorted((PREFIX / "share/man").rglob("*.[15]"))
check(
    len(formats) >= 5 and {p.name for p in pages if p.suffix == ".5"} == {f"relume-{f}.5" for f in formats},
    f"pages of section 5: {pages}")
for source in pages:
    page = run("man", "--warnings", "-P", "cat", "-l", source, env=dict(os.environ, MANWIDTH="80", LC_ALL="C.UTF-8"))
    text = re.sub(r".\x08", "", page.stdout)
    check(page.returncode == 0 and not page.stderr, f"man {source.name}: {page.stderr}")
    check("\nEXAMPLES\n" in text, f"man {source.name} has examples")
    check(re.search(r"^relume +20[2-9]\d-\d\d-\d\d ", text, re.M),
          f"man {source.name} has a recent date: {text[-200:]}")
keys = run(relume, "help", "look-file").stdout
shown = re.sub(
    r"\s+", " ",
    must(
        run("man", "-P", "cat", "-l", PREFIX / "share/man/man5/relume-look.5",
            env=dict(os.environ, MANWIDTH="300", LC_ALL="C.UTF-8"))).stdout)
wanted = re.findall(r"^ {8,}(?:- )?(\w+):.* # ", keys, re.M)
check(
    len(wanted) > 50 and all(f"{key}:" in shown for key in wanted),
    f"man 5 relume-look has every key: {[k for k in wanted if f'{k}:' not in shown]}")
# Links between installed documents; pages of the source that are not installed are no longer links.
documents = PREFIX / "share/doc/relume"
links = [(page.relative_to(documents), target, (page.parent / target).exists()) for page in documents.rglob("*.md")
         for target in re.findall(r"\]\((?!https?:)([^)#\s]+)", page.read_text(encoding="utf-8"))]
dead = [f"{page}: {target}" for page, target, there in links if not there]
check(len(links) > 25 and not dead, f"the {len(links)} links of installed documents lead somewhere: {dead}")
kept = {str(page.relative_to(documents)) for page in documents.rglob("*.md")}
check({"README.md", "SECURITY.md", "CHANGELOG.md", "docs/look.md"} <= kept, f"documents are installed: {kept}")
# The hooks and recipes that the pages mention.
examples = PREFIX / "share/doc/relume/examples"
check((examples / "hooks/toon.cl").exists() and (examples / "hooks/car_paint.look.yaml").exists(),
      "example hooks are installed")
must(run(relume, "hook", "--check", examples / "hooks/toon.cl", timeout=200))
for recipe in ("github.yml", "gitlab-ci.yml"):
    text = (examples / "ci" / recipe).read_text()
    check(yaml.safe_load(text) and "relume ci" in text, f"the recipe {recipe} is YAML that runs relume ci")
# The help texts themselves explain every option of the verbs' tables.
tables = {
    f"--{name}" for folder in ("capture", "diff", "replay", "verbs") for source in (ROOT / folder).rglob("*.c")
    for name in re.findall(r"\{ \"([a-z][a-z-]+)\", (?:0|'\w'), (?:NULL|\"[^\"]+\"), \"", source.read_text())
}
check(
    len(tables) > 30 and tables <= set().union(*options.values()),
    f"every option is explained: {tables - set().union(*options.values())}")

# Each shell completes a verb and its options, and no options of another verb.
BASH = f"""source '{PREFIX}/share/bash-completion/completions/relume'
COMP_WORDS=(relume "$@"); COMP_CWORD=$#; _relume; printf '%s\\n' "${{COMPREPLY[@]}}\""""
ZSH = f"""zmodload zsh/zpty; zpty shell zsh -f -i
zpty -w shell "PS1=; fpath=('{PREFIX}/share/zsh/site-functions' $fpath); autoload -U compinit; compinit -D -u; print rea''dy"
until [[ $line = *ready* ]]; do zpty -r shell line || exit 1; done
zpty -w -n shell "$1"$'\\t\\t'
sleep 1; while zpty -r -t shell line; do print -r -- $line; done"""


def by_bash(*words):
    return set(run("bash", "-c", BASH, "-", *words).stdout.split())


def by_zsh(*words):
    shown = subprocess.run(["env", "TERM=dumb", "zsh", "-f", "-c", ZSH, "-", " ".join(["relume", *words])],
                           stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, errors="replace", timeout=60,
                           cwd=SCRATCH, check=False).stdout
    return set(re.findall(r"(?<![\w-])[\w-]+", shown))


def by_fish(*words):
    home = dict(os.environ, HOME=str(SCRATCH), XDG_DATA_DIRS=str(PREFIX / "share"))
    done = run("fish", "--no-config", "-c", f"source '{PREFIX}/share/fish/vendor_completions.d/relume.fish'; "
               f"complete -C 'relume {' '.join(words)}'", env=home)
    return {line.split("\t")[0] for line in done.stdout.splitlines()}


for complete in (by_bash, by_zsh, by_fish):
    name = complete.__name__
    found = complete("rec")
    check("record" in found and "diff" not in found, f"{name}: relume rec -> {found}")
    found = complete("diff", "--j")
    check({"--json", "--junit"} <= found and "--report" not in found, f"{name}: relume diff --j -> {found}")
    found = complete("record", "--q")
    check("--quit-after" in found and "--json" not in found, f"{name}: relume record --q -> {found}")

must(make("uninstall"))
left = [str(p) for p in pathlib.Path(PLACE).rglob("*") if not p.is_dir()]
check(not left, f"uninstall leaves nothing: {left}")
check(not any((PREFIX / folder).exists() for folder in ("lib/relume", "share/relume", "share/doc/relume")),
      "nor one of our folders")
finish()
