/* relume approve: store traced frames as approved ones, for comparison with later frames. */
#include "base/verbs.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/memory.h"
#include "base/options.h"
#include "base/part.h"
#include "diff/baseline/baseline.h"
#include "diff/score/picture.h"
#include "diff/pictures/set.h"

struct options {
	const char *by, *reason;
	struct frame_list frames;
	int hashes, dry_run;
};

static const struct options_row rows[] = {
	{ "frames", 'f', "LIST", "frames to approve, as in 10-60 or 1-500x5 (default: all)", options_frames,
	  .at = offsetof(struct options, frames) },
	{ "hashes", 0, NULL, "store only hashes of the channels: small, but comparable only on the same device",
	  options_flag, .at = offsetof(struct options, hashes) },
	{ "by", 0, "NAME", "who approves (default: the user)", options_text, .at = offsetof(struct options, by) },
	{ "reason", 0, "TEXT", "why", options_text, .at = offsetof(struct options, reason) },
	{ "dry-run", 'n', NULL, "print what would change, without changing anything", options_flag,
	  .at = offsetof(struct options, dry_run) },
};

static const struct options_table table = {
	.verb = "approve",
	.head = "usage: relume approve [OPTIONS] TRACED BASELINE\n"
	        "\n"
	        "Approve traced frames: 'relume diff --baseline BASELINE' compares later ones with them.\n"
	        "Changes are printed frame by frame.\n"
	        "\n"
	        "TRACED    frames that 'relume render' wrote: a folder, a pattern, or one file\n"
	        "BASELINE  a folder with a subfolder for each device\n",
	OPTIONS_ROWS(rows),
	.notes = "The date is taken from SOURCE_DATE_EPOCH if it is set.\n",
	.takes = "TRACED and BASELINE", .least = 2, .most = 2,
};

static const char *user_name(const char *by)
{
	const struct passwd *entry = by ? NULL : getpwuid(getuid());

	return by ? by : entry ? entry->pw_name : "unknown";
}

static void format_day(char *out, size_t size)
{
	const char *epoch = getenv("SOURCE_DATE_EPOCH");
	time_t now = epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
	struct tm day;

	strftime(out, size, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &day));
}

/* A change to a file of the baseline. */
struct planned {
	const char *from; /* the frame to copy; borrowed */
	char *to;         /* its destination; NULL: none */
	char *part;       /* the copy under an unfinished name, until all are made; NULL: none */
	char *old;        /* an approved frame to remove, as the new one has another name or is not stored; NULL: none */
};

/* A variant being updated: frames approved before, and new ones. Strings are owned. */
struct update {
	const struct options *options;
	char *folder;
	struct baseline_variant variant; /* its texts are borrowed, its frames owned */
	uint32_t n_new, n_changed, n_same;
	struct planned *planned; /* owned, with its names */
	size_t n_planned, room;
	FILE *said;              /* text to print once everything is done */
};

static void free_update(struct update *u)
{
	for (uint32_t i = 0; i < u->variant.n_frames; i++) {
		free(u->variant.frames[i].file);
		free(u->variant.frames[i].channels);
	}
	free(u->variant.frames);
	for (size_t i = 0; i < u->n_planned; i++) {
		free(u->planned[i].to);
		free(u->planned[i].part);
		free(u->planned[i].old);
	}
	free(u->planned);
	free(u->folder);
}

/** Begin with the frames already approved for this device. */
static int begin_update(struct update *u, const struct baseline *b, const char *device)
{
	int own = baseline_variant_of(b, device);
	const struct baseline_variant *old = own >= 0 ? b->variants[own] : NULL;

	u->folder = baseline_folder(b->dir, device);
	u->variant.frames = calloc((old ? old->n_frames : 0) + 1, sizeof(*u->variant.frames));
	if (!u->folder || !u->variant.frames)
		return err_report(ERR_SYSTEM, b->dir, "out of memory");
	for (uint32_t i = 0; old && i < old->n_frames; i++) {
		struct baseline_frame *f = &u->variant.frames[u->variant.n_frames++];

		*f = old->frames[i];
		f->file = f->file ? strdup(f->file) : NULL;
		f->channels = strdup(f->channels);
		if (!f->channels || (old->frames[i].file && !f->file))
			return err_report(ERR_SYSTEM, b->dir, "out of memory");
	}
	return 0;
}

/** Report how a frame's picture changes, if the approved one is stored. */
static void print_change(const struct update *u, const struct baseline_frame *old, const struct image *img)
{
	struct score_picture was = { 0 }, now = { 0 };
	struct image image = { 0 };
	char path[4096];

	snprintf(path, sizeof(path), "%s/%s", u->folder, old->file ? old->file : "");
	if (!old->file || set_read_picture(path, &image) != 0) {
		fputs("only hashes were approved\n", u->said);
		return;
	}
	if (score_picture_from_image(&image, "beauty", &was) == 0 && score_picture_from_image(img, "beauty", &now) == 0 &&
	    was.width == now.width && was.height == now.height) {
		const size_t n = (size_t)was.width * was.height;
		size_t count = 0;
		int worst = 0;

		for (size_t i = 0; i < n; i++) {
			int d = score_code_difference(was.rgb + 3 * i, now.rgb + 3 * i);

			count += d > 0;
			worst = d > worst ? d : worst;
		}
		fprintf(u->said, "%zu of %zu pixels show it, by %d/255 at most\n", count, n, worst);
	} else {
		fputs("another size, or no colours\n", u->said);
	}
	score_picture_free(&was);
	score_picture_free(&now);
	image_free(&image);
}

/* --- Files: all or none ------------------------------------------------------------------------------------------ */

/* @param to  name of an unfinished file */
static int copy_file(const char *from, const char *to)
{
	FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
	char block[65536];
	size_t n;
	int err = in && out ? 0 : err_report(in ? ERR_SYSTEM : ERR_INPUT, in ? to : from, "%s", strerror(errno));

	while (!err && (n = fread(block, 1, sizeof(block), in)) > 0)
		if (fwrite(block, 1, n, out) < n)
			err = err_report(ERR_SYSTEM, to, "cannot be written: %s", strerror(errno));
	if (!err && ferror(in))
		err = err_report(ERR_INPUT, from, "cannot be read completely");
	if (in)
		fclose(in);
	if (out && fclose(out) && !err)
		err = err_report(ERR_SYSTEM, to, "cannot be written: %s", strerror(errno));
	return err;
}

/* FOLDER/NAME; NULL if out of memory or without a name. */
static char *path_of(const char *folder, const char *name)
{
	char *path = NULL;

	return name && asprintf(&path, "%s/%s", folder, name) >= 0 ? path : NULL;
}

static int plan(struct update *u, const char *from, const char *name, const char *old)
{
	const int goes = old && !(name && strcmp(name, old) == 0);
	struct planned *p;

	if (MEMORY_GROW(u->planned, u->room, u->n_planned + 1))
		return ERR_SYSTEM;
	p = &u->planned[u->n_planned++];
	*p = (struct planned){ .from = from, .to = path_of(u->folder, name), .old = path_of(u->folder, goes ? old : NULL) };
	return (name && !p->to) || (goes && !p->old) ? err_report(ERR_SYSTEM, u->folder, "out of memory") : 0;
}

/* Copy a frame to an unfinished file. */
static int copy_frame(struct planned *p)
{
	char part[PATH_MAX + 128];
	int err = part_begin(p->to, part, sizeof(part));

	if (!err && !(p->part = strdup(part)))
		err = err_report(ERR_SYSTEM, p->to, "out of memory");
	return err ? err : copy_file(p->from, p->part);
}

/* Copy all new frames to unfinished files, and rename them only once all are complete. */
static int carry_out(struct update *u)
{
	const int failed = folder_try_early(u->folder, 0);
	int err = failed ? err_report(ERR_SYSTEM, u->folder, "%s", strerror(failed)) : 0;

	for (size_t i = 0; !err && i < u->n_planned; i++)
		err = u->planned[i].to ? copy_frame(&u->planned[i]) : 0;
	for (size_t i = 0; i < u->n_planned; i++) {
		if (u->planned[i].part && err)
			part_drop(u->planned[i].part);
		else if (u->planned[i].part)
			err = part_finish(u->planned[i].part, u->planned[i].to);
	}
	if (!err)
		err = baseline_write(u->folder, &u->variant);
	for (size_t i = 0; !err && i < u->n_planned; i++)
		if (u->planned[i].old)
			unlink(u->planned[i].old);
	return err;
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static int approve_frame(struct update *u, const struct set_entry *entry, const struct image *img, char *channels)
{
	struct baseline_frame *f = baseline_find(&u->variant, entry->frame), *grown;
	const char *extension = strrchr(entry->path, '.');
	char name[64], *old;
	int err, same = f && strcmp(f->channels, channels) == 0 && !!f->file == !u->options->hashes;

	if (same) {
		u->n_same++;
		free(channels);
		return 0;
	}
	if (f && strcmp(f->channels, channels) == 0) {
		fprintf(u->said, "frame %" PRIu64 ": %s\n", entry->frame, f->file ? "keeps only its hashes" : "is stored, too");
		u->n_changed++;
	} else if (f) {
		fprintf(u->said, "frame %" PRIu64 ": changed: ", entry->frame);
		print_change(u, f, img);
		u->n_changed++;
	} else {
		fprintf(u->said, "frame %" PRIu64 ": new\n", entry->frame);
		u->n_new++;
		grown = realloc(u->variant.frames, (u->variant.n_frames + 1) * sizeof(*grown));
		if (!grown) {
			free(channels);
			return err_report(ERR_SYSTEM, u->folder, "out of memory");
		}
		u->variant.frames = grown;
		/* keep them sorted, for baseline_find */
		uint32_t at = u->variant.n_frames++;

		for (; at > 0 && grown[at - 1].frame > entry->frame; at--)
			grown[at] = grown[at - 1];
		f = &grown[at];
		*f = (struct baseline_frame){ .frame = entry->frame };
	}
	free(f->channels);
	f->channels = channels;
	f->width = img->width;
	f->height = img->height;
	snprintf(name, sizeof(name), "frame.%04" PRIu64 "%.16s", entry->frame, extension ? extension : "");
	old = f->file;
	f->file = u->options->hashes ? NULL : strdup(name);
	err = !u->options->hashes && !f->file ? err_report(ERR_SYSTEM, u->folder, "out of memory")
		: plan(u, entry->path, f->file, old);
	free(old);
	return err;
}

static const char *attribute_or(const struct image *img, const char *name, const char *otherwise)
{
	const char *text = image_attribute(img, name);

	return text ? text : otherwise;
}

/** The first frame sets device and provenance; all others must come from the same device and trace. */
static int approve_all(const struct options *o, struct set *set, const struct baseline *b)
{
	size_t n_text;
	char *text = NULL;
	struct update u = { .options = o, .said = open_memstream(&text, &n_text) };
	char device[256] = "", trace[256] = "", version[256] = "", settings[600] = "", day[32];
	int err = u.said ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; !err && i < set->n_entries; i++) {
		const struct set_entry *entry = &set->entries[i];
		struct image img = { 0 };
		char *channels = NULL;

		if (!frame_list_contains(&o->frames, entry->frame))
			continue;
		if (!entry->path)
			err = err_report(ERR_USAGE, set->name, "these are reference frames; approve traced ones");
		if (!err)
			err = set_read(set, entry, &img);
		if (!err && !image_attribute(&img, "relume:device"))
			err = err_report(ERR_INPUT, entry->path, "not a traced frame: it has no attribute relume:device");
		if (!err && !u.folder) {
			snprintf(device, sizeof(device), "%s", image_attribute(&img, "relume:device"));
			snprintf(trace, sizeof(trace), "%s", attribute_or(&img, "relume:trace", ""));
			snprintf(version, sizeof(version), "%s", attribute_or(&img, "relume:version", ""));
			snprintf(settings, sizeof(settings), "%s, encoding %s, channels %s", attribute_or(&img, "relume:settings", "?"),
			         attribute_or(&img, "relume:encoding", "linear"), attribute_or(&img, "relume:aov", "all"));
			err = begin_update(&u, b, device);
		}
		if (!err && (strcmp(device, image_attribute(&img, "relume:device")) != 0 ||
		             strcmp(trace, attribute_or(&img, "relume:trace", "")) != 0))
			err = err_report(ERR_USAGE, entry->path, "this frame comes from another device or trace than the first one");
		if (!err && !(channels = baseline_hash_channels(&img)))
			err = err_report(ERR_SYSTEM, entry->path, "out of memory");
		if (!err)
			err = approve_frame(&u, entry, &img, channels);
		image_free(&img);
	}
	if (!err && !u.folder)
		err = err_report(ERR_USAGE, set->name, "none of the requested frames exists");
	if (!err) {
		format_day(day, sizeof(day));
		u.variant.device = device;
		u.variant.trace = trace;
		u.variant.relume = version;
		u.variant.settings = settings;
		u.variant.approved_by = (char *)user_name(o->by);
		u.variant.approved_at = day;
		u.variant.reason = (char *)(o->reason ? o->reason : "");
		fprintf(u.said, "%s: %u new, %u changed, %u as approved before%s\n", u.folder, u.n_new, u.n_changed, u.n_same,
		        o->dry_run ? "; nothing was written" : "");
		if (!o->dry_run && u.n_new + u.n_changed > 0)
			err = carry_out(&u);
	}
	if (u.said && fclose(u.said) && !err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		fputs(text, stdout);
	free(text);
	free_update(&u);
	return err;
}

int approve_main(int argc, char **argv)
{
	struct options o = { 0 };
	struct set set = { 0 };
	struct baseline baseline = { 0 };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &o, &line);

	if (!err)
		err = set_open(line.words[0], &set);
	if (!err)
		err = baseline_open(line.words[1], &baseline);
	if (!err)
		err = approve_all(&o, &set, &baseline);
	baseline_close(&baseline);
	set_free(&set);
	frame_list_free(&o.frames);
	return err > 0 ? 0 : -err;
}
