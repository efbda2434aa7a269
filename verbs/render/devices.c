/* relume devices: lists the devices that can render, and checks what they draw. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/json.h"
#include "base/options.h"
#include "base/verbs.h"
#include "tracer/device/outcome.h"
#include "verbs/render/check/check.h"

#define DEFAULT_SECONDS 300

struct asked {
	const char *device, *cache;
	unsigned seconds;
	int check, json;
};

static const struct options_row rows[] = {
	{ "check", 0, NULL,
	  "draw small scenes with every family of kernels, compare them with the pictures of the C twins, time them, "
	  "and keep the results, which 'relume render' uses",
	  options_flag, .at = offsetof(struct asked, check) },
	{ "device", 0, "NAME", "only this one, by number, type or part of the name (default: all)", options_text,
	  .at = offsetof(struct asked, device) },
	{ "timeout", 0, "S",
	  "seconds that --check waits for a scene: a family that is not done then counts as wrong (default 300)",
	  options_number, .at = offsetof(struct asked, seconds), .most = 86400 },
	{ "cache", 0, "DIR",
	  "folder for these results, as for 'relume render' (default: relume/devices in $XDG_CACHE_HOME, or in "
	  "~/.cache)",
	  options_text, .at = offsetof(struct asked, cache) },
	{ "json", 0, NULL, "as JSON", options_flag, .at = offsetof(struct asked, json) },
};

static const struct options_table table = {
	.verb = "devices",
	.head = "usage: relume devices [--check] [OPTIONS]\n"
		"\n"
		"List the OpenCL devices: number, type, name, compute units and the floats that each computes with at "
	        "once, memory,\n"
		"the family of traversal kernels that it runs (render --kernels names another), platform and driver. "
	        "The number, the\n"
		"type (cpu, gpu, accelerator: the first of it) or any part of the name is what --device takes; without "
	        "--device the\n"
		"first GPU is used, else the first device.\n"
		"'--device reference' runs the kernels' C twins: slow, needs no OpenCL.\n"
		"\n"
		"A device runs the family that suits its type, until --check has found out which are right there and "
	        "which of these is\n"
		"the fastest. That counts until the driver or Relume's kernels change. Run it once on a new machine or "
	        "driver: it takes\n"
		"a minute or two, as every kernel is compiled. Each family has a process of its own, so that a driver "
	        "that crashes or\n"
		"hangs stops nothing. Where one does so while 'relume render' runs, that is remembered, too, until the "
	        "next --check, and\n"
		"the list names it. Packets are for CPUs, and passed over elsewhere. The table: compile is what "
	        "compiling took of all\n"
		"kernels, frame a picture of 480 x 360 once all is compiled.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes of --check: 0 all families are right on all devices, 1 one is not, 5 on some device none "
	         "is: there\n"
		 "'relume render' takes no --device but 'reference'.\n",
	.takes = "no arguments",
};

/* A device, and what is known of it. */
struct known {
	const struct device_description *device;
	size_t number;
	int is_known;            /* there is an outcome */
	struct outcome outcome;
	struct check_result checked[N_DEVICE_FAMILIES]; /* results of this run, with --check */
};

/* The family used for rendering; -1: none is right. */
static int family_of(const struct known *k)
{
	return k->is_known ? outcome_best(&k->outcome, device_type_family(k->device->type)) :
	                     (int)device_type_family(k->device->type);
}

static const char *name_of_family(int family)
{
	return family < 0 ? "none" : device_family_names[family];
}

/* --- As JSON ----------------------------------------------------------------------------------------------------- */

static void print_family(struct json *j, const struct known *k, int family, int check)
{
	static const char *const words[N_OUTCOME_STATES] = { "not tried", "right", "wrong", "failed", "late", "passed over" };
	const struct outcome_family *f = &k->outcome.families[family];

	json_begin(j, '{');
	json_key_string(j, "kernels", device_family_names[family]);
	json_key_string(j, "state", words[f->state]);
	json_key_string(j, "where", f->where);
	json_key_float(j, "compile_s", f->compile_s);
	json_key_float(j, "frame_ms", 1e3 * f->frame_s);
	if (check) {
		json_key(j, "scenes");
		json_begin(j, '{');
		for (int i = 0; i < N_CHECK_SCENES; i++)
			json_key_string(j, check_scene_names[i],
			                k->checked[family].scenes[i].state < 0 ? "not tried" : words[k->checked[family].scenes[i].state]);
		json_end(j, '}');
	}
	json_end(j, '}');
}

static void print_json(struct json *j, const struct known *k, int check)
{
	const struct device_description *d = k->device;

	json_begin(j, '{');
	json_key_uint(j, "number", k->number);
	json_key_string(j, "name", d->name);
	json_key_string(j, "platform", d->platform);
	json_key_string(j, "driver", d->driver);
	json_key_string(j, "version", d->version);
	json_key_string(j, "type", device_type_name(d->type));
	json_key_uint(j, "units", d->units);
	json_key_uint(j, "width", d->width);
	json_key_uint(j, "memory_bytes", d->memory_bytes);
	json_key_uint(j, "buffer_bytes", d->buffer_bytes);
	json_key_string(j, "kernels", name_of_family(family_of(k)));
	if (k->is_known) {
		json_key(j, "families");
		json_begin(j, '[');
		for (int i = 0; i < N_DEVICE_FAMILIES; i++)
			print_family(j, k, i, check);
		json_end(j, ']');
	}
	json_end(j, '}');
}

/* Why it runs its family. */
static const char *say_why(const struct known *k, char *text, size_t size)
{
	const struct outcome_family *f = k->outcome.families;
	char words[160];

	text[0] = '\0';
	for (int i = N_DEVICE_FAMILIES - 1; i >= 0 && k->is_known; i--)
		if (f[i].state == OUTCOME_FAILED || f[i].state == OUTCOME_LATE)
			snprintf(text, size, ", as %s %s", device_family_names[i], outcome_words(&f[i], words, sizeof(words)));
	for (int i = 0; i < N_DEVICE_FAMILIES && k->is_known; i++)
		if (f[i].state == OUTCOME_RIGHT)
			snprintf(text, size, ", as checked");
	return text;
}

/* --- As text ----------------------------------------------------------------------------------------------------- */

static void print_line(const struct known *k)
{
	const struct device_description *d = k->device;
	char why[224];

	printf("%zu  %s  %s, %u units of width %u, %llu MiB, kernels: %s%s  (%s %s)\n", k->number,
	       device_type_name(d->type), d->name, d->units, d->width, (unsigned long long)(d->memory_bytes >> 20),
	       name_of_family(family_of(k)), say_why(k, why, sizeof(why)), d->platform, d->driver);
}

static void print_row(const struct known *k, int family)
{
	const struct check_result *r = &k->checked[family];
	char text[160], frame[32] = "-";

	if (r->all.frame_s > 0)
		snprintf(frame, sizeof(frame), "%.1f ms", 1e3 * r->all.frame_s);
	printf("%-2zu  %-40.40s  %-10s  %8.1f s  %12s  %s", k->number, k->device->name, device_family_names[family],
	       r->all.compile_s, frame, outcome_words(&r->all, text, sizeof(text)));
	for (int i = 0; i < N_CHECK_SCENES; i++)
		if (r->scenes[i].state == OUTCOME_WRONG)
			printf("; %s: %u pixels of %s", check_scene_names[i], r->scenes[i].n_differ, r->scenes[i].channel);
	putchar('\n');
	fflush(stdout);
}

/* --- Checking ---------------------------------------------------------------------------------------------------- */

/* Packets use vector types, which GPU compilers take minutes for, and which do not help GPUs. */
static int is_for(const struct device_description *device, enum device_family family)
{
	return device->type == DEVICE_CPU || family != FAMILY_PACKETS;
}

static int check_one(const struct asked *o, const struct check_truth *truth, struct known *k, enum device_family family)
{
	int err = 0;

	if (is_for(k->device, family)) {
		err = check_family(truth, k->number, family, o->seconds ? o->seconds : DEFAULT_SECONDS, &k->checked[family]);
	} else {
		k->checked[family].all.state = OUTCOME_PASSED_OVER;
		for (int i = 0; i < N_CHECK_SCENES; i++)
			k->checked[family].scenes[i].state = -1;
	}
	k->outcome.families[family] = k->checked[family].all;
	if (!err && !o->json)
		print_row(k, family);
	return err;
}

/* Check a device, and keep the outcome. @return 0; ERR_FAILED: a family is not right; ERR_SYSTEM (reported): none
 * is, or there was no result */
static int check_device(const struct asked *o, const struct check_truth *truth, const char *folder, struct known *k)
{
	int err = 0, n_right = 0, n_sound = 0; /* sound: right or passed over */

	for (int i = 0; i < N_DEVICE_FAMILIES && !err; i++) {
		err = check_one(o, truth, k, (enum device_family)i);
		n_right += k->outcome.families[i].state == OUTCOME_RIGHT;
		n_sound += k->outcome.families[i].state == OUTCOME_RIGHT || k->outcome.families[i].state == OUTCOME_PASSED_OVER;
	}
	if (err)
		return err;
	k->is_known = 1;
	if (folder)
		outcome_write(folder, k->device, &k->outcome);
	if (n_right == 0)
		return err_report(ERR_SYSTEM, k->device->name,
		                  "no kernels are right on this device: render with another --device, or with "
		                  "--device reference (slow)");
	return n_sound < N_DEVICE_FAMILIES ? ERR_FAILED : 0;
}

/* List or check devices `first` to `last` - 1. */
static int go_through(const struct asked *o, const struct device_description *list, size_t first, size_t last)
{
	struct json j = { .out = stdout };
	struct check_truth truth = { 0 };
	struct known k;
	char users[4096];
	const char *folder = o->cache ? o->cache : folder_cached("devices", users, sizeof(users)) ? users : NULL;
	int err = o->check ? check_truth_make(&truth) : 0, worst = 0;

	if (o->json)
		json_begin(&j, '[');
	else if (o->check && !err)
		printf("%-2s  %-40s  %-10s  %10s  %12s  %s\n", "", "device", "kernels", "compile", "frame", "pictures");
	for (size_t i = first; i < last && !err; i++) {
		memset(&k, 0, sizeof(k));
		k.device = &list[i];
		k.number = i;
		if (o->check) {
			const int found = check_device(o, &truth, folder, &k);

			worst = found < worst ? found : worst;
		} else {
			k.is_known = folder && outcome_read(folder, k.device, &k.outcome);
		}
		if (o->json)
			print_json(&j, &k, o->check);
		else if (!o->check)
			print_line(&k);
	}
	if (o->json)
		json_end(&j, ']');
	check_truth_free(&truth);
	return err ? err : worst;
}

int devices_main(int argc, char **argv)
{
	struct asked o = { 0 };
	struct options_line line;
	struct device_description *list = NULL;
	size_t n, first = 0;
	int err = options_parse(&table, argc, argv, &o, &line);

	if (err)
		return err > 0 ? 0 : -err;
	err = o.check ? check_list(&list, &n) : device_list(&list, &n);
	if (!err && o.device)
		err = device_find(list, n, o.device, &first);
	if (!err)
		err = go_through(&o, list, first, o.device ? first + 1 : n);
	free(list);
	return -err;
}
