/* Finds the frames of a .ref file, a folder, a pattern or an image, and reads them. */
#include "diff/pictures/set.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/frames.h"
#include "base/hash.h"
#include "tracer/image/foreign.h"
#include "tracer/image/place.h"

void set_free(struct set *set)
{
	for (size_t i = 0; i < set->n_entries; i++) {
		free(set->entries[i].path);
		free(set->entries[i].name);
	}
	free(set->entries);
	free(set->name);
	free(set->trace);
	if (set->ref.stream)
		ref_close(&set->ref);
	*set = (struct set){ 0 };
}

/** Add an entry; `path` is copied. */
static int add_entry(struct set *set, uint64_t frame, const char *path)
{
	char *copy = NULL;

	if (memory_resize(&set->entries, set->n_entries + 1, sizeof(*set->entries)))
		return ERR_SYSTEM;
	if (path && !(copy = strdup(path)))
		return err_report(ERR_SYSTEM, set->name, "out of memory");
	set->entries[set->n_entries++] = (struct set_entry){ .frame = frame, .path = copy };
	return 0;
}

static const char *extension_of(const char *path)
{
	const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');

	return dot ? dot + 1 : "";
}

static int is_image_name(const char *path)
{
	/* picture formats of OpenImageIO; which of them it reads depends on its build */
	static const char *const known[] = {
		"exr", "png", "jpg", "jpe", "jpeg", "tif", "tiff", "tx", "bmp", "dib", "tga", "tpic", "ppm", "pgm", "pbm", "pnm",
		"pfm", "hdr", "rgbe", "webp", "dpx", "cin", "sgi", "rgb", "rgba", "bw", "int", "inta", "gif", "psd", "pdd", "psb",
		"jp2", "j2k", "j2c", "dds", "iff", "rla", "pic", "fits", "heic", "heif", "avif", "jxl", "dcm", "zfile",
	};

	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++)
		if (strcasecmp(extension_of(path), known[i]) == 0)
			return 1;
	return 0;
}

static int is_digit(char c)
{
	return c >= '0' && c <= '9';
}

/** The last number in a file name before its extension; 0 if none. */
static int number_of_name(const char *name, uint64_t *frame)
{
	const char *end = strrchr(name, '.'), *start;

	if (!end)
		end = name + strlen(name);
	while (end > name && !is_digit(end[-1]))
		end--;
	for (start = end; start > name && is_digit(start[-1]); start--)
		;
	if (start == end || end - start > 18)
		return 0;
	*frame = strtoull(start, NULL, 10);
	return 1;
}

/** Find the frame whose expansion of the pattern is this path; 0 if none. */
static int number_by_pattern(const char *pattern, const char *path, uint64_t *frame)
{
	for (const char *p = path; *p; p++) {
		char expanded[4096];

		if (!is_digit(*p) || (p > path && is_digit(p[-1])))
			continue;
		*frame = strtoull(p, NULL, 10);
		if (strlen(path) < sizeof(expanded) - 32 &&
		    frame_pattern_expand(pattern, *frame, expanded, sizeof(expanded)) == 0 && strcmp(expanded, path) == 0)
			return 1;
	}
	return 0;
}

static int compare_entries(const void *a, const void *b)
{
	const struct set_entry *x = a, *y = b;

	return (x->frame > y->frame) - (x->frame < y->frame);
}

/** Give the last entry its name: its path from letter `skip` on, without extension. */
static int name_entry(struct set *set, size_t skip, int has_number)
{
	struct set_entry *entry = &set->entries[set->n_entries - 1];
	const char *path = entry->path + skip;
	const char *ending = extension_of(path);

	entry->name = strndup(path, *ending ? (size_t)(ending - path) - 1 : strlen(path));
	entry->has_number = has_number;
	return entry->name ? 0 : err_report(ERR_SYSTEM, set->name, "out of memory");
}

static int sort_entries(struct set *set)
{
	if (set->n_entries == 0)
		return err_report(ERR_INPUT, set->name, "there is no numbered image");
	qsort(set->entries, set->n_entries, sizeof(*set->entries), compare_entries);
	for (size_t i = 1; i < set->n_entries; i++)
		if (set->entries[i].frame == set->entries[i - 1].frame)
			return err_report(ERR_USAGE, set->name, "two images of frame %" PRIu64 ", %s and %s; name one "
			                  "series by a pattern such as DIR/NAME.####.exr", set->entries[i].frame,
			                  set->entries[i - 1].path, set->entries[i].path);
	return 0;
}

/** List the images of a folder that match a pattern; NULL: those with a number. */
static int open_folder(struct set *set, const char *folder, const char *pattern)
{
	DIR *dir = opendir(folder[0] ? folder : ".");
	int err = 0;

	if (!dir)
		return err_report(ERR_INPUT, folder, "%s", strerror(errno));
	for (struct dirent *file; !err && (file = readdir(dir));) {
		const char *slash = folder[0] && folder[strlen(folder) - 1] != '/' ? "/" : "";
		char path[4096];
		uint64_t frame;

		if (file->d_name[0] == '.' || (!pattern && !is_image_name(file->d_name)))
			continue;
		if (snprintf(path, sizeof(path), "%s%s%s", folder, slash, file->d_name) >= (int)sizeof(path))
			continue;
		if (pattern ? number_by_pattern(pattern, path, &frame) : number_of_name(file->d_name, &frame))
			err = add_entry(set, frame, path);
	}
	closedir(dir);
	return err ? err : sort_entries(set);
}

enum { MOST_DEPTH = 16 };

/** List all images of a folder and its subfolders, with names. @param root  length of the set's own folder and its
 * slash */
static int open_tree(struct set *set, const char *folder, size_t root, int depth)
{
	char page[4096];
	DIR *dir;
	int err = 0;

	if (depth && snprintf(page, sizeof(page), "%s/index.html", folder) < (int)sizeof(page) && access(page, F_OK) == 0)
		return 0; /* a report of relume diff */
	dir = opendir(folder);
	if (!dir)
		return err_report(ERR_INPUT, folder, "%s", strerror(errno));
	for (struct dirent *file; !err && (file = readdir(dir));) {
		const char *slash = folder[strlen(folder) - 1] != '/' ? "/" : "";
		char path[4096];
		struct stat st;
		uint64_t frame = 0;

		if (file->d_name[0] == '.' ||
		    snprintf(path, sizeof(path), "%s%s%s", folder, slash, file->d_name) >= (int)sizeof(path))
			continue;
		if (stat(path, &st) == 0 && S_ISDIR(st.st_mode)) {
			if (depth < MOST_DEPTH)
				err = open_tree(set, path, root, depth + 1);
			else
				err_warn(path, "is nested too deep and is skipped");
		} else if (is_image_name(file->d_name)) {
			const int has_number = depth == 0 && number_of_name(file->d_name, &frame);

			err = add_entry(set, frame, path);
			if (!err)
				err = name_entry(set, root, has_number);
		}
	}
	closedir(dir);
	return err;
}

static int open_named(struct set *set, const char *folder)
{
	const size_t n = strlen(folder);
	int err = open_tree(set, folder, n + (folder[n - 1] != '/'), 0);

	if (!err && set->n_entries == 0)
		err = err_report(ERR_INPUT, folder, "contains no picture");
	return err;
}

static int open_pattern(struct set *set, const char *pattern)
{
	const char *slash = strrchr(pattern, '/');
	char *folder = slash ? strndup(pattern, (size_t)(slash - pattern) + 1) : strdup("");
	int err;

	if (!folder)
		return err_report(ERR_SYSTEM, pattern, "out of memory");
	if (frame_pattern_has_number(folder))
		err = err_report(ERR_USAGE, pattern, "the frame number must be in the file's name, not in a folder's");
	else
		err = open_folder(set, folder, pattern);
	free(folder);
	return err;
}

static int open_ref(struct set *set, const char *path)
{
	int err = ref_open(&set->ref, path);

	for (size_t i = 0; !err && i < set->ref.n_entries; i++)
		if (set->ref.entries[i].kind == REF_COLOR)
			err = add_entry(set, set->ref.entries[i].frame, NULL);
	if (!err && set->n_entries == 0)
		err = err_report(ERR_INPUT, path, "contains no colour frame");
	if (!err)
		qsort(set->entries, set->n_entries, sizeof(*set->entries), compare_entries);
	return err;
}

/** Open NAME.ref beside NAME.trace. */
static int open_trace(struct set *set, const char *trace)
{
	const char *extension = extension_of(trace);
	size_t stem = strlen(trace) - (extension[0] ? strlen(extension) + 1 : 0);
	char path[4096];
	struct stat st;
	int err;

	if (snprintf(path, sizeof(path), "%.*s.ref", (int)stem, trace) >= (int)sizeof(path))
		return err_report(ERR_USAGE, trace, "the file name is too long");
	if (stat(path, &st) != 0)
		return err_report(ERR_INPUT, trace, "there are no reference frames beside it (%s); record with --ref color,depth, "
		                  "or make them with 'relume raster' and name the images here", path);
	free(set->name);
	set->name = strdup(path);
	set->trace = strdup(trace);
	if (!set->name || !set->trace)
		return err_report(ERR_SYSTEM, path, "out of memory");
	err = stat(trace, &st) == 0 ? hash_name(trace, (uint64_t)st.st_size, set->trace_hash)
	                            : err_report(ERR_INPUT, trace, "%s", strerror(errno));
	return err ? err : open_ref(set, path);
}

/** Read the first bytes of a file, zeros beyond its end. @return 0, or ERR_SYSTEM (reported): it cannot be read */
static int read_head(const char *path, uint8_t head[8])
{
	FILE *f = fopen(path, "rb");
	int err = 0;

	memset(head, 0, 8);
	if (f && fread(head, 1, 8, f) != 8 && ferror(f))
		err = err_report(ERR_SYSTEM, path, "cannot be read: %s", strerror(errno));
	if (f)
		fclose(f);
	return err;
}

static int open_set(const char *where, int with_names, struct set *out)
{
	struct stat st;
	uint64_t frame = 0;
	uint8_t head[8];
	int err;

	out->name = strdup(where);
	if (!out->name)
		return err_report(ERR_SYSTEM, where, "out of memory");
	if (stat(where, &st) != 0) {
		if (errno == ENOENT && frame_pattern_has_number(where))
			err = open_pattern(out, where);
		else
			err = err_report(ERR_INPUT, where, "%s", strerror(errno));
	} else if (S_ISDIR(st.st_mode)) {
		err = with_names ? open_named(out, where) : open_folder(out, where, NULL);
	} else if ((err = read_head(where, head))) {
		/* unknown until read */
	} else if (ref_begins(head)) { /* its name may be anything */
		err = open_ref(out, where);
	} else if (strcasecmp(extension_of(where), "ref") == 0) {
		err = err_report(ERR_INPUT, where, "not a file of reference frames");
	} else if (is_image_name(where)) {
		const char *slash = strrchr(where, '/');

		const int has_number = number_of_name(slash ? slash + 1 : where, &frame);

		out->is_single = 1;
		err = add_entry(out, frame, where);
		if (!err && with_names)
			err = name_entry(out, slash ? (size_t)(slash - where) + 1 : 0, has_number);
	} else {
		err = open_trace(out, where);
	}
	if (err)
		set_free(out);
	return err;
}

int set_open(const char *where, struct set *out)
{
	return open_set(where, 0, out);
}

int set_open_named(const char *where, struct set *out)
{
	return open_set(where, 1, out);
}

const struct set_entry *set_find(const struct set *set, uint64_t frame)
{
	struct set_entry key = { .frame = frame };

	if (set->n_entries == 0)
		return NULL;
	return bsearch(&key, set->entries, set->n_entries, sizeof(key), compare_entries);
}

/** Copy a record's pixels into the image, flipped: top row first. */
static int add_record(const struct set *set, enum ref_kind kind, uint64_t frame, struct image *img)
{
	const struct ref_entry *entry = ref_find(&set->ref, kind, frame);
	float *planes[3] = { NULL };
	void *pixels = NULL;
	int err;

	if (kind == REF_DEPTH && (!entry || entry->width != img->width || entry->height != img->height))
		return 0; /* depth was not recorded */
	if (!entry)
		return err_report(ERR_INPUT, set->name, "frame %" PRIu64 " has no colour", frame);
	img->width = entry->width;
	img->height = entry->height;
	err = ref_read(&set->ref, entry, &pixels);
	if (err)
		return err;
	for (int c = 0; c < (kind == REF_COLOR ? 3 : 1); c++) {
		planes[c] = image_add_channel(img, kind == REF_COLOR ? (const char[]){ "RGB"[c], 0 } : "gl.depth", 1);
		if (!planes[c])
			goto fail;
	}
	for (size_t y = 0; y < img->height; y++) {
		for (size_t x = 0; x < img->width; x++) {
			size_t to = y * img->width + x, from = (img->height - 1 - y) * img->width + x;

			if (kind == REF_DEPTH)
				memcpy(&planes[0][to], (const char *)pixels + from * sizeof(float), sizeof(float));
			else
				for (int c = 0; c < 3; c++)
					planes[c][to] = (float)((const uint8_t *)pixels)[4 * from + (size_t)c] / 255;
		}
	}
	free(pixels);
	return 0;
fail:
	free(pixels);
	return ERR_SYSTEM;
}

int set_read_picture(const char *path, struct image *img)
{
	uint8_t head[8];
	int err = read_head(path, head);
	const int is_exr = memcmp(head, "\x76\x2f\x31\x01", 4) == 0;
	/* Version field, bits 9, 11 and 12: tiled, deep or multi-part files, which image.h does not read. */
	const int is_plain = is_exr && (head[5] & 0x1a) == 0;

	if (err)
		return err;
	if (strcasecmp(extension_of(path), "exr") == 0 && (is_plain || !is_exr) && !(is_exr && image_exr_is_dwa(path)))
		err = image_read_exr(img, path);
	else if (!is_exr || (err = image_check_exr(path)) == 0)
		err = foreign_read(img, path);
	if (!err)
		err = image_place(img, path);
	if (err)
		image_free(img);
	return err;
}

int set_read(const struct set *set, const struct set_entry *entry, struct image *img)
{
	int err;

	if (entry->path) {
		err = set_read_picture(entry->path, img);
		if (!err && entry->name && !entry->has_number) /* matched by path: gate V expects the number of the match */
			err = image_set_attribute(img, "relume:frame", "%" PRIu64, entry->frame);
		if (err)
			image_free(img);
		return err;
	}
	err = add_record(set, REF_COLOR, entry->frame, img);
	if (!err)
		err = add_record(set, REF_DEPTH, entry->frame, img);
	if (!err)
		err = image_set_attribute(img, "relume:encoding", "display");
	if (!err)
		err = image_set_attribute(img, "relume:record", "%s", set->name);
	if (err)
		image_free(img);
	return err;
}
