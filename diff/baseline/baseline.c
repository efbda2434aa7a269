/* Reads and writes baseline.yaml, and looks up a frame's approved version. */
#include "diff/baseline/baseline.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/config.h"
#include "base/err.h"
#include "base/json.h"
#include "base/part.h"
#include "diff/pictures/set.h"

static const cyaml_schema_field_t frame_fields[] = {
	CYAML_FIELD_UINT("frame", CYAML_FLAG_DEFAULT, struct baseline_frame, frame),
	CYAML_FIELD_UINT("width", CYAML_FLAG_DEFAULT, struct baseline_frame, width),
	CYAML_FIELD_UINT("height", CYAML_FLAG_DEFAULT, struct baseline_frame, height),
	CYAML_FIELD_STRING_PTR("file", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, struct baseline_frame, file, 1,
	                       CYAML_UNLIMITED),
	CYAML_FIELD_STRING_PTR("channels", CYAML_FLAG_POINTER, struct baseline_frame, channels, 0, CYAML_UNLIMITED),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t frame_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct baseline_frame, frame_fields)
};

/* Text members of struct baseline_variant, under their names in the file. */
#define TEXTS(ROW) ROW(device) ROW(trace) ROW(relume) ROW(settings) ROW(approved_by) ROW(approved_at) ROW(reason)
#define FIELD(member) \
	CYAML_FIELD_STRING_PTR(#member, CYAML_FLAG_POINTER, struct baseline_variant, member, 0, CYAML_UNLIMITED),

static const cyaml_schema_field_t variant_fields[] = {
	FIELD(format) CYAML_FIELD_UINT("version", CYAML_FLAG_DEFAULT, struct baseline_variant, version),
	TEXTS(FIELD)
	CYAML_FIELD_SEQUENCE_COUNT("frames", CYAML_FLAG_POINTER, struct baseline_variant, frames, n_frames, &frame_schema, 0,
	                           CYAML_UNLIMITED),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t variant_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct baseline_variant, variant_fields)
};

static int compare_frames(const void *a, const void *b)
{
	const struct baseline_frame *x = a, *y = b;

	return (x->frame > y->frame) - (x->frame < y->frame);
}

static int add_variant(struct baseline *b, const char *folder)
{
	struct baseline_variant **variants = realloc(b->variants, (b->n_variants + 1) * sizeof(*variants));
	char **folders = realloc(b->folders, (b->n_variants + 1) * sizeof(*folders)), path[4096];
	struct baseline_variant *v = NULL;
	int err;

	b->variants = variants ? variants : b->variants;
	b->folders = folders ? folders : b->folders;
	if (!variants || !folders)
		return err_report(ERR_SYSTEM, folder, "out of memory");
	if (snprintf(path, sizeof(path), "%s/baseline.yaml", folder) >= (int)sizeof(path))
		return err_report(ERR_INPUT, folder, "the name is too long");
	if (access(path, F_OK) != 0)
		return 0; /* an unrelated folder */
	err = config_load(path, &variant_schema, (void **)&v);
	if (!err && (strcmp(v->format, "relume-baseline") != 0 || v->version != 1))
		err = err_report(ERR_INPUT, path, "unknown format %s %u", v->format, v->version);
	for (uint32_t i = 0; !err && i < v->n_frames; i++)
		if (v->frames[i].file && strchr(v->frames[i].file, '/'))
			err = err_report(ERR_INPUT, path, "frame %" PRIu64 ": its file is in another folder", v->frames[i].frame);
	folders[b->n_variants] = err ? NULL : strdup(folder);
	if (!err && !folders[b->n_variants])
		err = err_report(ERR_SYSTEM, folder, "out of memory");
	if (err) {
		config_free(&variant_schema, v);
		return err;
	}
	qsort(v->frames, v->n_frames, sizeof(*v->frames), compare_frames);
	variants[b->n_variants++] = v;
	return 0;
}

int baseline_open(const char *dir, struct baseline *out)
{
	struct dirent **names;
	int n, err = 0;

	out->dir = strdup(dir);
	if (!out->dir)
		return err_report(ERR_SYSTEM, dir, "out of memory");
	n = scandir(dir, &names, NULL, alphasort);
	if (n < 0 && errno == ENOENT)
		return 0;
	if (n < 0) {
		err = err_report(ERR_INPUT, dir, "%s", strerror(errno));
		baseline_close(out);
		return err;
	}
	for (int i = 0; i < n; i++) {
		char folder[4096];

		if (!err && names[i]->d_name[0] != '.' &&
		    snprintf(folder, sizeof(folder), "%s/%s", dir, names[i]->d_name) < (int)sizeof(folder))
			err = add_variant(out, folder);
		free(names[i]);
	}
	free(names);
	if (err)
		baseline_close(out);
	return err;
}

void baseline_close(struct baseline *b)
{
	for (size_t i = 0; i < b->n_variants; i++) {
		config_free(&variant_schema, b->variants[i]);
		free(b->folders[i]);
	}
	free(b->variants);
	free(b->folders);
	free(b->dir);
	*b = (struct baseline){ 0 };
}

struct baseline_frame *baseline_find(const struct baseline_variant *variant, uint64_t frame)
{
	struct baseline_frame key = { .frame = frame };

	if (variant->n_frames == 0)
		return NULL;
	return bsearch(&key, variant->frames, variant->n_frames, sizeof(key), compare_frames);
}

int baseline_variant_of(const struct baseline *b, const char *device)
{
	for (size_t i = 0; device && i < b->n_variants; i++)
		if (strcmp(b->variants[i]->device, device) == 0)
			return (int)i;
	return -1;
}

static int compare_channels(const void *a, const void *b)
{
	const struct image_channel *const *x = a, *const *y = b;

	return strcmp((*x)->name, (*y)->name);
}

char *baseline_hash_channels(const struct image *img)
{
	const size_t bytes = (size_t)img->width * img->height * sizeof(float);
	const struct image_channel **sorted = malloc((img->n_channels + 1) * sizeof(*sorted));
	char *text = calloc(img->n_channels + 1, sizeof(img->channels[0].name) + 18), *at = text;

	if (!sorted || !text) {
		free(sorted);
		free(text);
		return NULL;
	}
	for (size_t i = 0; i < img->n_channels; i++)
		sorted[i] = &img->channels[i];
	qsort(sorted, img->n_channels, sizeof(*sorted), compare_channels);
	for (size_t i = 0; i < img->n_channels; i++)
		at += sprintf(at, "%s%s:%016" PRIx64, i ? " " : "", sorted[i]->name,
		              (uint64_t)XXH64(sorted[i]->values, bytes, 0));
	free(sorted);
	return text;
}

char *baseline_folder(const char *dir, const char *device)
{
	char *text;

	if (asprintf(&text, "%s/%s", dir, device) < 0)
		return NULL;
	for (char *c = text + strlen(dir) + 1; *c; c++)
		if (!isalnum((unsigned char)*c) && *c != '.' && *c != '-')
			*c = '_';
	return text;
}

/** Compare two sorted lists of channel hashes: which names differ, and whether both have the same names. */
static void compare_lists(const char *now, const char *was, struct score_approved *out)
{
	size_t used = 0;

	out->same_channels = out->same_hashes = 1;
	while (*now || *was) {
		int n = (int)strcspn(now, " "), w = (int)strcspn(was, " ");
		int now_name = (int)strcspn(now, ":"), was_name = (int)strcspn(was, ":");
		int order = !*now ? 1 : !*was ? -1
			: strncmp(now, was, (size_t)(now_name > was_name ? now_name : was_name) + 1);
		const char *name = order <= 0 ? now : was;
		int length = order <= 0 ? now_name : was_name;

		if (order != 0 || n != w || strncmp(now, was, (size_t)n) != 0) {
			out->same_hashes = 0;
			out->same_channels &= order == 0;
			if (used + (size_t)length + 2 < sizeof(out->changed))
				used += (size_t)sprintf(out->changed + used, "%s%.*s", used ? " " : "", length, name);
		}
		if (order <= 0)
			now += n + (now[n] == ' ');
		if (order >= 0)
			was += w + (was[w] == ' ');
	}
}

int baseline_look_up(const struct baseline *b, const struct image *img, uint64_t frame, struct image *was,
                     struct score_approved *out, int *found)
{
	const char *device = image_attribute(img, "relume:device");
	int own = baseline_variant_of(b, device), chosen = own >= 0 && baseline_find(b->variants[own], frame) ? own : -1;
	const struct baseline_frame *f;
	char *hashes, path[4096];

	*found = 0;
	*out = (struct score_approved){ .same_device = chosen >= 0 };
	for (size_t i = 0; chosen < 0 && i < b->n_variants; i++)
		if (baseline_find(b->variants[i], frame))
			chosen = (int)i;
	if (chosen < 0)
		return 0;
	f = baseline_find(b->variants[chosen], frame);
	hashes = baseline_hash_channels(img);
	if (!hashes)
		return err_report(ERR_SYSTEM, b->dir, "out of memory");
	compare_lists(hashes, f->channels, out);
	free(hashes);
	if (f->width != img->width || f->height != img->height)
		out->same_hashes = 0;
	*found = out->same_hashes || out->same_device || f->file;
	if (out->same_hashes || !f->file)
		return 0;
	if (snprintf(path, sizeof(path), "%s/%s", b->folders[chosen], f->file) >= (int)sizeof(path))
		return err_report(ERR_INPUT, b->folders[chosen], "the name is too long");
	out->image = was;
	return set_read_picture(path, was);
}

/** Write text between double quotes, as YAML requires. */
static void write_text(FILE *out, const char *key, const char *text)
{
	struct json json = { .out = out };

	fprintf(out, "%s: ", key);
	json_string(&json, text);
	fputc('\n', out);
}

/** Write a file's name, without quotes if YAML reads it as text anyway. */
static void write_name(FILE *out, const char *name)
{
	fputs("file: ", out);
	if (isalpha((unsigned char)*name) &&
	    name[strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-")] == '\0')
		fputs(name, out);
	else
		json_string(&(struct json){ .out = out }, name);
	fputs(", ", out);
}

int baseline_write(const char *folder, const struct baseline_variant *v)
{
	struct part_file file;
	char path[4096];

	if (snprintf(path, sizeof(path), "%s/baseline.yaml", folder) >= (int)sizeof(path))
		return err_report(ERR_SYSTEM, folder, "the name is too long");
	if (part_open(&file, path) != 0)
		return ERR_SYSTEM;
	fputs("format: relume-baseline\nversion: 1\n", file.stream);
#define WRITE(member) write_text(file.stream, #member, v->member);
	TEXTS(WRITE)
	fputs(v->n_frames ? "frames:\n" : "frames: []\n", file.stream);
	for (uint32_t i = 0; i < v->n_frames; i++) {
		const struct baseline_frame *f = &v->frames[i];

		fprintf(file.stream, "- {frame: %" PRIu64 ", width: %u, height: %u, ", f->frame, f->width, f->height);
		if (f->file)
			write_name(file.stream, f->file);
		fputs("channels: ", file.stream);
		json_string(&(struct json){ .out = file.stream }, f->channels);
		fputs("}\n", file.stream);
	}
	return part_close(&file, 0);
}
