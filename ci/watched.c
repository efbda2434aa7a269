/* Lists and hashes the inputs of a recording, and compares them with those of the last one. */
#include "ci/watched.h"

#include <dirent.h>
#include <elf.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

#include "base/beside.h"
#include "base/err.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/part.h"
#include "base/program.h"
#include "base/table.h"
#include "base/version.h"

/* Interpreters of interpreters to follow; nested folders; bytes to search for a script's or program's interpreter */
enum { MOST_FOLLOWED = 4, MOST_FOLDERS = 40, HEAD_BYTES = 4096 };

struct collector {
	const struct ci_program *program;
	struct watched *watched;
	FILE *lines, *folders;
	struct table added; /* files by a hash of device and inode: programs share libraries */
};

/* Write one line. The value is quoted, as a name may hold any byte. */
static void put(struct collector *c, const char *kind, const char *value)
{
	fprintf(c->lines, "%s ", kind);
	json_string(&(struct json){ .out = c->lines }, value);
	fputc('\n', c->lines);
}

static int is_file(const char *path)
{
	struct stat info;

	return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

static int is_folder(const char *path)
{
	struct stat info;

	return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* Note that a file is added. @return 1 if it was before, under any name */
static int note_added(struct collector *c, const char *path, int *err)
{
	uint64_t key[2] = { 0, 0 };
	struct stat info;
	int was;

	if (stat(path, &info) != 0)
		return 0;
	key[0] = info.st_dev;
	key[1] = info.st_ino;
	was = table_find(&c->added, XXH3_64bits(key, sizeof(key))) != NULL;
	*err = table_set(&c->added, XXH3_64bits(key, sizeof(key)), c);
	return was;
}

/* Add a file with the hash of its content, unless it was added before. */
static int add_file(struct collector *c, const char *path)
{
	uint64_t hash[2];
	char kind[64];
	int err = 0;

	if (note_added(c, path, &err) || err)
		return err;
	err = hash_whole(path, hash);
	if (err)
		return err;
	snprintf(kind, sizeof(kind), "file %016" PRIx64 "%016" PRIx64, hash[0], hash[1]);
	put(c, kind, path);
	c->watched->n_files++;
	return 0;
}

/* --- Programs and their libraries ------------------------------------------------------------------------------- */

/* Find the loader that a program names (PT_INTERP). @return 1; 0: not a program, or it needs no loader */
static int find_loader(const unsigned char *head, size_t n, char *out, size_t size)
{
	const int is_64 = n > EI_CLASS && head[EI_CLASS] == ELFCLASS64;
	Elf64_Ehdr elf64;
	Elf32_Ehdr elf32;
	uint64_t at, step, count;

	if (n < sizeof(elf64) || memcmp(head, ELFMAG, SELFMAG) != 0)
		return 0;
	memcpy(&elf64, head, sizeof(elf64));
	memcpy(&elf32, head, sizeof(elf32));
	at = is_64 ? elf64.e_phoff : elf32.e_phoff;
	step = is_64 ? sizeof(Elf64_Phdr) : sizeof(Elf32_Phdr);
	count = is_64 ? elf64.e_phnum : elf32.e_phnum;
	for (uint64_t i = 0; i < count && at <= n && at + (i + 1) * step <= n; i++) {
		Elf64_Phdr part64;
		Elf32_Phdr part32;
		uint64_t type, from, length;

		memcpy(&part64, head + at + i * step, is_64 ? sizeof(part64) : 0);
		memcpy(&part32, head + at + i * step, is_64 ? 0 : sizeof(part32));
		type = is_64 ? part64.p_type : part32.p_type;
		from = is_64 ? part64.p_offset : part32.p_offset;
		length = is_64 ? part64.p_filesz : part32.p_filesz;
		if (type == PT_INTERP && from < n && length <= n - from)
			return snprintf(out, size, "%.*s", (int)length, (const char *)head + from) < (int)size;
	}
	return 0;
}

/* The loader lists "\tlibm.so.6 => /lib/libm.so.6 (0x7f...)". An entry without a path is the kernel's, or missing. */
static int add_libraries(struct collector *c, const char *loader, const char *program)
{
	const uint32_t n = c->program->n_environment;
	char **argv = calloc((size_t)n + 5, sizeof(*argv)), *text = NULL;
	int code, err = 0;

	if (!argv)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	argv[0] = (char *)"env";
	memcpy(argv + 1, c->program->environment, n * sizeof(*argv));
	argv[n + 1] = (char *)loader;
	argv[n + 2] = (char *)"--list";
	argv[n + 3] = (char *)program;
	code = program_read(argv, 0, &text);
	free(argv);
	if (code < 0)
		return code;
	if (code) {
		err_warn(program, "its libraries cannot be listed, so it is recorded");
		c->watched->is_unknown = 1;
	}
	for (char *line = code ? NULL : strtok(text, "\n"); !err && line; line = strtok(NULL, "\n")) {
		char *path = strstr(line, "=> "), *end = strstr(line, " (0x");

		path = path ? path + 3 : line + strspn(line, "\t ");
		if (*path != '/' || !end)
			continue;
		*end = '\0';
		err = add_file(c, path);
	}
	free(text);
	return err;
}

/* Add a file and what it needs to run: a program's libraries, a script's interpreter. */
static int add_runnable(struct collector *c, const char *path, int depth)
{
	unsigned char head[HEAD_BYTES + 1] = { 0 };
	char other[PATH_MAX], *word, *rest;
	FILE *file = fopen(path, "rb");
	const size_t n = file ? fread(head, 1, HEAD_BYTES, file) : 0;
	int err = add_file(c, path);

	if (file)
		fclose(file);
	if (err || depth == MOST_FOLLOWED)
		return err;
	if (find_loader(head, n, other, sizeof(other)))
		return add_libraries(c, other, path);
	if (memcmp(head, "#!", 2) != 0)
		return 0;
	head[strcspn((char *)head, "\n")] = '\0';
	/* "#!/usr/bin/env python3": follow each word that is a program */
	for (word = strtok_r((char *)head + 2, " \t", &rest); word && !err; word = strtok_r(NULL, " \t", &rest))
		if (program_find(word, other, sizeof(other)))
			err = add_runnable(c, other, depth + 1);
	return err;
}

/* --- Data ------------------------------------------------------------------------------------------------------- */

/* Add a file, or all files below a folder. depth: of the folder, 0 for what --data names */
static int add_data(struct collector *c, const char *path, int depth)
{
	struct dirent **names;
	int n, err = 0;

	if (is_file(path))
		return add_file(c, path);
	if (!is_folder(path))
		return depth ? 0
			: err_report(ERR_INPUT, path, "is neither a file nor a folder: --data names what the program reads");
	n = depth < MOST_FOLDERS ? scandir(path, &names, NULL, alphasort) : -1;
	if (n < 0)
		return err_report(ERR_INPUT, path, "this folder cannot be read");
	for (int i = 0; i < n; i++) {
		char inner[PATH_MAX];

		if (!err && strcmp(names[i]->d_name, ".") != 0 && strcmp(names[i]->d_name, "..") != 0) {
			if (snprintf(inner, sizeof(inner), "%s/%s", path, names[i]->d_name) >= (int)sizeof(inner))
				err = err_report(ERR_INPUT, path, "a path in it is too long");
			else
				err = add_data(c, inner, depth + 1);
		}
		free(names[i]);
	}
	free(names);
	return err;
}

/* Add a file that an argument names: "model.obj" or "--model=model.obj". */
static int add_argument(struct collector *c, const char *word)
{
	const char *value = strchr(word, '=');

	value = !is_file(word) && !is_folder(word) && value ? value + 1 : word;
	if (is_folder(value))
		fprintf(c->folders, "%s%s", ftell(c->folders) ? ", " : "", value);
	return is_file(value) ? add_runnable(c, value, 1) : 0;
}

/* --- All inputs -------------------------------------------------------------------------------------------------- */

static int collect(struct collector *c, const char *program)
{
	const struct ci_program *p = c->program;
	char recorder[PATH_MAX];
	int err = beside_find("librelume.so", recorder, sizeof(recorder));

	fprintf(c->lines, "relume \"" RELUME_VERSION "\"\nframes \"%u\"\n", p->frames);
	for (uint32_t i = 0; i < p->n_command; i++)
		put(c, "command", p->command[i]);
	for (uint32_t i = 0; i < p->n_environment; i++)
		put(c, "environment", p->environment[i]);
	for (uint32_t i = 0; i < p->n_press; i++)
		put(c, "press", p->press[i]);
	if (!err)
		err = add_file(c, recorder);
	if (!err)
		err = add_runnable(c, program, 0);
	for (uint32_t i = 1; !err && i < p->n_command; i++)
		err = add_argument(c, p->command[i]);
	for (uint32_t i = 0; !err && i < p->n_data; i++)
		err = add_data(c, p->data[i], 0);
	return err;
}

int watched_collect(const struct ci_program *p, const char *program, struct watched *out)
{
	struct collector c = { .program = p, .watched = out };
	size_t n, n_folders;
	int err;

	c.lines = open_memstream(&out->text, &n);
	c.folders = open_memstream(&out->not_watched, &n_folders);
	err = c.lines && c.folders ? collect(&c, program) : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (c.lines && fclose(c.lines) && !err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (c.folders && fclose(c.folders) && !err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	table_free(&c.added);
	return err;
}

void watched_free(struct watched *w)
{
	free(w->text);
	free(w->not_watched);
	*w = (struct watched){ 0 };
}

/* 1 if a text has this line. */
static int has_line(const char *text, const char *line, size_t n)
{
	for (const char *at = text; (at = strstr(at, "\n")); at++)
		if (strncmp(at + 1, line, n) == 0 && at[1 + n] == '\n')
			return 1;
	return strncmp(text, line, n) == 0 && text[n] == '\n';
}

/* Count the lines of a text that another text lacks, and describe the first in `why`. */
static size_t compare(const char *text, const char *other, const char *verb, char *why, size_t size)
{
	size_t n_different = 0;

	for (const char *line = text; *line; line += strcspn(line, "\n") + 1) {
		const int n = (int)strcspn(line, "\n"), is_file_line = strncmp(line, "file ", 5) == 0;
		const char *quote = memchr(line, '"', (size_t)n);

		if (has_line(other, line, (size_t)n))
			continue;
		if (!n_different++ && is_file_line)
			snprintf(why, size, "%.*s %s", (int)(line + n - quote) - 2, quote + 1, verb);
		else if (n_different == 1)
			snprintf(why, size, "%.*s: %.*s", (int)(quote - line) - 1, line, (int)(line + n - quote), quote);
	}
	return n_different;
}

static char *read_text(const char *path)
{
	FILE *file = fopen(path, "rb");
	char *text = NULL;
	size_t size = 0;

	if (file && getdelim(&text, &size, '\0', file) < 0) {
		free(text);
		text = NULL;
	}
	if (file)
		fclose(file);
	return text;
}

int watched_changed(const struct watched *w, const char *kept, char *why, size_t size)
{
	char *before = read_text(kept);
	size_t n = 0;

	if (!before)
		snprintf(why, size, "there is no complete recording yet");
	else if (w->is_unknown)
		snprintf(why, size, "its libraries are not known");
	else if (strcmp(before, w->text) != 0) {
		/* The same lines in another order are a different command. */
		snprintf(why, size, "the order of its arguments has changed");
		n = compare(w->text, before, "has changed", why, size);
		n = n ? n : compare(before, w->text, "is gone", why, size);
		if (n > 1)
			snprintf(why + strlen(why), size - strlen(why), ", and %zu more", n - 1);
	} else {
		why[0] = '\0';
	}
	free(before);
	return why[0] != '\0';
}

int watched_keep(const struct watched *w, const char *kept)
{
	struct part_file file;
	int err = part_open(&file, kept);

	if (err)
		return err;
	fputs(w->text, file.stream);
	return part_close(&file, 0);
}
