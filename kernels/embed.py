"""Converts the kernels to C text, so that the command contains them and compiles them at run time without other files.

usage: embed.py OUT.c OUT.d INCLUDE_DIR... -- FILE.cl...

The first #include "..." of each file is replaced by the file's text, searched beside the including file and then in the
given folders; for NAME_lanes.h (kernels/one_lanes.h), every #include is. #line keeps the line numbers of compiler
messages. OUT.c defines kernel_files and kernel_places (kernels/embed.h). OUT.d lists the files read, for make. The same
input gives the same bytes.
"""
import os
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
KERNEL = re.compile(r'^(?:__kernel|KERNEL_OF\(\w+\)) void (\w+)', re.MULTILINE)


def expand(path, folders, seen):
    """The lines of a file with its includes in place, each file but those of lanes once; `seen` collects all."""
    seen.append(path)
    lines = ['#line 1 "%s"' % path]
    with open(path, encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            found = INCLUDE.match(line)
            if not found:
                lines.append("" if line.startswith("#pragma once") else line.rstrip("\n"))
                continue
            places = [os.path.join(folder, found.group(1)) for folder in [os.path.dirname(path)] + folders]
            inner = next((place for place in places if os.path.isfile(place)), None)
            if inner is None:
                sys.exit("%s:%d: no file %s" % (path, number, found.group(1)))
            if os.path.normpath(inner) in seen and not inner.endswith("_lanes.h"):
                lines.append("")  # it has #pragma once
                continue
            lines += expand(os.path.normpath(inner), folders, seen)
            lines.append('#line %d "%s"' % (number + 1, path))
    return lines


def quote(line):
    return '\t"' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t") + '\\n"'


def main():
    out_c, out_d = sys.argv[1:3]
    split = sys.argv.index("--")
    folders, files = sys.argv[3:split], sorted(sys.argv[split + 1:])
    read, places = set(), []
    text = [
        "/* Made by kernels/embed.py from %s. */" % (" ".join(files) or "no files"), '#include "kernels/embed.h"', "",
        "const struct kernel_file kernel_files[] = {"
    ]
    for index, path in enumerate(files):
        seen = []
        lines = expand(path, folders, seen)
        read.update(seen)
        places += [(name, index) for name in KERNEL.findall("\n".join(lines))]
        text.append('\t{ "%s",' % path)
        text += [quote(line) for line in lines]
        text.append("\t, %d }," % any(inner.endswith(".cl") for inner in seen[1:]))
    text += ["\t{ 0, 0, 0 }", "};", "const size_t n_kernel_files = %d;" % len(files), "",
             "const struct kernel_place kernel_places[] = {"]
    text += ['\t{ "%s", %d },' % place for place in sorted(places)]
    text += ["\t{ 0, 0 }", "};", "const size_t n_kernel_places = %d;" % len(places), ""]
    with open(out_c, "w", encoding="utf-8") as out:
        out.write("\n".join(text))
    with open(out_d, "w", encoding="utf-8") as out:
        out.write("%s: %s\n" % (out_c, " ".join(sorted(read))))
        out.write("".join("%s:\n" % path for path in sorted(read)))


main()
