/* Matches the pictures of sets: by number, else by path. */
#include "diff/pictures/match.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "tracer/image/image.h"

static int compare_numbers(const void *a, const void *b)
{
	const struct set_entry *x = a, *y = b;
	const int order = (x->frame > y->frame) - (x->frame < y->frame);

	return order ? order : x->name && y->name ? strcmp(x->name, y->name) : 0;
}

static int compare_names(const void *a, const void *b)
{
	const struct set_entry *x = a, *y = b;

	return strcmp(x->name, y->name);
}

/* 1 if another set has a picture of that name. */
static int is_elsewhere(struct set *const *sets, size_t n_sets, size_t own, const char *name)
{
	for (size_t s = 0; s < n_sets; s++)
		for (size_t i = 0; s != own && i < sets[s]->n_entries; i++)
			if (sets[s]->entries[i].name && strcmp(sets[s]->entries[i].name, name) == 0)
				return 1;
	return 0;
}

/* 1 if another set has a picture that is matched by that number. */
static int is_wanted(struct set *const *sets, size_t n_sets, size_t own, uint64_t frame)
{
	for (size_t s = 0; s < n_sets; s++)
		for (size_t i = 0; s != own && i < sets[s]->n_entries; i++)
			if (sets[s]->entries[i].frame == frame && (sets[s]->entries[i].has_number || !sets[s]->entries[i].name))
				return 1;
	return 0;
}

/* Match all pictures with this number by name, in all sets. */
static void forget_number(struct set *const *sets, size_t n_sets, uint64_t frame)
{
	for (size_t s = 0; s < n_sets; s++)
		for (size_t i = 0; i < sets[s]->n_entries; i++)
			if (sets[s]->entries[i].frame == frame)
				sets[s]->entries[i].has_number = 0;
}

/* Find numbers that two pictures of a set share. Names distinguish them if other sets have the names, or not the
 * number. */
static int find_doubles(struct set *const *sets, size_t n_sets, size_t own)
{
	struct set *set = sets[own];

	qsort(set->entries, set->n_entries, sizeof(*set->entries), compare_numbers);
	for (size_t i = 1; i < set->n_entries; i++) {
		const struct set_entry *a = &set->entries[i - 1], *b = &set->entries[i];

		if (a->frame != b->frame || !a->has_number || !b->has_number)
			continue;
		/* a single set is compared with a baseline, which has numbers */
		if (n_sets == 1 || (is_wanted(sets, n_sets, own, a->frame) && !is_elsewhere(sets, n_sets, own, a->name) &&
		                    !is_elsewhere(sets, n_sets, own, b->name)))
			return err_report(ERR_USAGE, set->name, "two images of frame %" PRIu64 ", %s and %s; name one series by a "
			                  "pattern such as DIR/NAME.####.exr", a->frame, a->path, b->path);
		forget_number(sets, n_sets, a->frame);
	}
	return 0;
}

/* Take the number of a Relume frame from its file. */
static void number_by_file(struct set_entry *entry)
{
	char text[24];

	if (!image_exr_text(entry->path, "relume:frame", text, sizeof(text)))
		return;
	entry->frame = strtoull(text, NULL, 10);
	entry->has_number = 1;
}

/* Drop pictures without a number. */
static int drop_named(struct set *set)
{
	size_t n = 0, dropped = 0;

	for (size_t i = 0; i < set->n_entries; i++) {
		struct set_entry *entry = &set->entries[i];

		if (set->is_single && entry->name && !entry->has_number)
			number_by_file(entry);
		if (entry->has_number || !entry->name || set->is_single) {
			set->entries[n++] = *entry;
			continue;
		}
		if (!dropped++)
			err_warn(entry->path, "has no number%s and is not compared: the other side is matched by number",
			         strchr(entry->name, '/') ? " of a frame in this folder" : "");
		free(entry->path);
		free(entry->name);
	}
	set->n_entries = n;
	return n ? 0 : err_report(ERR_INPUT, set->name, "there is no numbered image");
}

/* Number all names, after all numbers in use. */
static int number_names(struct set *const *sets, size_t n_sets)
{
	struct set_entry *all;
	uint64_t next = 1;
	size_t n = 0;

	for (size_t s = 0; s < n_sets; s++)
		n += sets[s]->n_entries;
	all = malloc((n + 1) * sizeof(*all));
	if (!all)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	n = 0;
	for (size_t s = 0; s < n_sets; s++)
		for (size_t i = 0; i < sets[s]->n_entries; i++) {
			const struct set_entry *entry = &sets[s]->entries[i];

			if (entry->name && !entry->has_number)
				all[n++] = *entry;
			else if (entry->frame >= next)
				next = entry->frame + 1;
		}
	qsort(all, n, sizeof(*all), compare_names);
	for (size_t i = 0; i < n; i++)
		all[i].frame = i && strcmp(all[i].name, all[i - 1].name) == 0 ? all[i - 1].frame : next++;
	for (size_t s = 0; s < n_sets; s++)
		for (size_t i = 0; i < sets[s]->n_entries; i++) {
			struct set_entry *entry = &sets[s]->entries[i];

			if (entry->name && !entry->has_number)
				entry->frame = ((const struct set_entry *)bsearch(entry, all, n, sizeof(*all), compare_names))->frame;
		}
	free(all);
	return 0;
}

/* Report an error if a set has no numbers, and no name in common with another set. */
static int check_common(struct set *const *sets, size_t n_sets, size_t own)
{
	const struct set *set = sets[own];

	for (size_t i = 0; i < set->n_entries; i++)
		if (set->entries[i].has_number || is_elsewhere(sets, n_sets, own, set->entries[i].name))
			return 0;
	return err_report(ERR_INPUT, set->name, "contains no numbered image, and none with a path that %s has",
	                  sets[own ? 0 : n_sets - 1]->name);
}

static int finish(struct set *set)
{
	qsort(set->entries, set->n_entries, sizeof(*set->entries), compare_numbers);
	for (size_t i = 1; i < set->n_entries; i++)
		if (set->entries[i].frame == set->entries[i - 1].frame)
			return err_report(ERR_USAGE, set->name, "two pictures named %s: %s and %s", set->entries[i].name,
			                  set->entries[i - 1].path, set->entries[i].path);
	for (size_t i = 0; i < set->n_entries; i++)
		if (set->entries[i].has_number) {
			free(set->entries[i].name);
			set->entries[i].name = NULL;
		}
	return 0;
}

int set_match(struct set *const *sets, size_t n_sets, int only_numbers)
{
	int err = 0;

	for (size_t s = 0; s < n_sets; s++)
		for (size_t i = 0; i < sets[s]->n_entries; i++)
			only_numbers |= !sets[s]->entries[i].name;
	for (size_t s = 0; s < n_sets && !err; s++)
		err = find_doubles(sets, n_sets, s);
	for (size_t s = 0; s < n_sets && !err && only_numbers; s++)
		err = sets[s]->n_entries ? drop_named(sets[s]) : 0;
	for (size_t s = 0; s < n_sets && !err && !only_numbers; s++)
		err = check_common(sets, n_sets, s);
	if (!err && !only_numbers)
		err = number_names(sets, n_sets);
	for (size_t s = 0; s < n_sets && !err; s++)
		err = finish(sets[s]);
	return err;
}
