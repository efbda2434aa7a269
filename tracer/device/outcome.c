#include "tracer/device/outcome.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/kept.h"
#include "kernels/embed.h"

/* Raise when a check tests something else, or when struct outcome changes. */
#define OUTCOME_VERSION 6

/* Update two independent hashes. */
static void mix(uint64_t key[2], const char *text)
{
	key[0] = XXH3_64bits_withSeed(text, strlen(text) + 1, key[0]);
	key[1] = XXH64(text, strlen(text) + 1, key[1]);
}

/* Make the path of a device's file, and the key that its content must have. @return 0: the path is too long */
static int name_file(const char *folder, const struct device_description *device, char path[PATH_MAX], uint64_t key[2])
{
	uint64_t name;

	key[0] = key[1] = OUTCOME_VERSION;
	mix(key, device->name);
	mix(key, device->platform);
	name = key[0];
	mix(key, device->driver);
	mix(key, device->version);
	mix(key, device_type_name(device->type));
	for (size_t i = 0; i < n_kernel_files; i++)
		mix(key, kernel_files[i].text);
	return snprintf(path, PATH_MAX, "%s/%016llx.outcome", folder, (unsigned long long)name) < PATH_MAX;
}

static int is_sound(const struct outcome *o)
{
	for (int i = 0; i < N_DEVICE_FAMILIES; i++)
		if (o->families[i].state >= N_OUTCOME_STATES || !memchr(o->families[i].where, '\0', sizeof(o->families[i].where)))
			return 0;
	return 1;
}

int outcome_read(const char *folder, const struct device_description *device, struct outcome *out)
{
	char path[PATH_MAX];
	uint64_t key[2];
	void *bytes;
	size_t n;
	int found;

	if (!name_file(folder, device, path, key) || !kept_read(path, key, &bytes, &n))
		return 0;
	found = n == sizeof(*out);
	if (found)
		memcpy(out, bytes, n);
	free(bytes);
	return found && is_sound(out);
}

void outcome_write(const char *folder, const struct device_description *device, const struct outcome *outcome)
{
	char path[PATH_MAX];
	uint64_t key[2];
	int failed = 0;

	if (name_file(folder, device, path, key))
		failed = kept_write(path, key, outcome, sizeof(*outcome));
	if (failed > 0)
		err_warn(folder, "cannot save the outcome of checking a device here: %s", strerror(failed));
}

int outcome_best(const struct outcome *outcome, enum device_family preferred)
{
	const struct outcome_family *f = outcome->families;
	int best = -1;

	for (int i = 0; i < N_DEVICE_FAMILIES; i++)
		if (f[i].state == OUTCOME_RIGHT && (best < 0 || f[i].frame_s < f[best].frame_s))
			best = i;
	if (best < 0 && f[preferred].state == OUTCOME_UNTRIED)
		best = (int)preferred;
	for (int i = 0; i < N_DEVICE_FAMILIES && best < 0; i++)
		if (f[i].state == OUTCOME_UNTRIED)
			best = i;
	return best;
}

const char *outcome_words(const struct outcome_family *family, char *text, size_t size)
{
	static const char *const words[N_OUTCOME_STATES] = {
		"not tried", "right", "wrong", "failed", "not done in time", "not for this kind of device"
	};

	snprintf(text, size, family->where[0] ? "%s: %s" : "%s", words[family->state], family->where);
	return text;
}

/* --- Faults of a run --------------------------------------------------------------------------------------------- */

/* Add a run's faults of a device to its outcome. @return number of faults */
static size_t add_faults(const struct outcome_run *run, const struct device_description *device, int only_builds,
                         struct outcome *outcome)
{
	size_t n = 0;

	for (size_t i = 0; i < run->n; i++) {
		const struct fault *fault = &run->faults[i];
		struct outcome_family *family = &outcome->families[fault->family];

		if (fault->device != (int)device->number || (only_builds && !fault->is_build))
			continue;
		family->state = fault->kind == FAULT_HUNG ? OUTCOME_LATE : OUTCOME_FAILED;
		fault_words(fault, family->where, sizeof(family->where));
		n++;
	}
	return n;
}

/* Read the outcome kept in a folder; all families are untried if there is none. Packets are for CPUs: on other devices
 * no run falls back to them. */
static struct outcome known_of(const struct device_description *device, const char *folder)
{
	struct outcome outcome;

	if (folder && outcome_read(folder, device, &outcome))
		return outcome;
	memset(&outcome, 0, sizeof(outcome));
	if (device->type != DEVICE_CPU)
		outcome.families[FAMILY_PACKETS].state = OUTCOME_PASSED_OVER;
	return outcome;
}

static void remember(const struct device_description *device, const char *folder, const struct outcome_run *run,
                     int only_builds)
{
	struct outcome outcome = known_of(device, folder);

	if (folder && add_faults(run, device, only_builds, &outcome))
		outcome_write(folder, device, &outcome);
}

void outcome_remember_builds(const struct device *dev, const char *folder, const struct outcome_run *run)
{
	if (device_describe(dev))
		remember(device_describe(dev), folder, run, 1);
}

static void say_choice(const struct device *dev, enum device_family preferred, enum device_family best,
                       const struct outcome *outcome)
{
	char text[160];

	if (outcome->families[preferred].state != OUTCOME_RIGHT && best != preferred)
		err_warn(device_name(dev),
		         "renders with --kernels %s: %s kernels are not right here (%s); 'relume devices --check' "
		         "looks again",
		         device_family_names[best], device_family_names[preferred],
		         outcome_words(&outcome->families[preferred], text, sizeof(text)));
}

void outcome_confirm(struct device *dev, const char *folder, const struct outcome_run *run)
{
	const struct device_description *device = device_describe(dev);
	enum device_family failed = device_family(dev);
	struct outcome outcome;

	if (!device)
		return;
	outcome = known_of(device, folder);
	if (!add_faults(run, device, 0, &outcome))
		return;
	for (size_t i = 0; i < run->n; i++)
		if (run->faults[i].device == (int)device->number)
			failed = (enum device_family)run->faults[i].family;
	say_choice(dev, failed, device_family(dev), &outcome);
	remember(device, folder, run, 0);
}

/* --- The choice -------------------------------------------------------------------------------------------------- */

/* Report that no family is left. One line names each family and what is wrong with it. */
static int refuse(const struct device *dev, const struct outcome *outcome)
{
	char text[160], all[N_DEVICE_FAMILIES * 180] = "";
	size_t n = 0;

	for (int i = 0; i < N_DEVICE_FAMILIES; i++)
		if (outcome->families[i].state != OUTCOME_PASSED_OVER)
			n += (size_t)snprintf(all + n, sizeof(all) - n, "%s%s %s", n ? "; " : "", device_family_names[i],
			                      outcome_words(&outcome->families[i], text, sizeof(text)));
	return err_report(
		ERR_SYSTEM, device_name(dev),
		"no kernels are right on this device (%s): choose another --device, or --device reference (slow); "
		"'relume devices --check' looks again",
		all);
}

static int take_asked(struct device *dev, enum device_family asked, const struct outcome *outcome, int is_fault)
{
	const struct outcome_family *family = &outcome->families[asked];
	char text[160];

	outcome_words(family, text, sizeof(text));
	if (is_fault)
		return err_report(
			ERR_SYSTEM, device_name(dev),
			"--kernels %s does not work here (%s); without --kernels another family takes its place",
			device_family_names[asked], text);
	if (family->state != OUTCOME_UNTRIED && family->state != OUTCOME_RIGHT && family->state != OUTCOME_PASSED_OVER)
		err_warn(device_name(dev),
		         "--kernels %s is not right here, by 'relume devices --check' or an earlier run (%s)",
		         device_family_names[asked], text);
	device_choose_family(dev, asked);
	return 0;
}

int outcome_is_hopeless(const struct device *dev, int asked, const char *folder, const struct outcome_run *run)
{
	const struct device_description *device = device_describe(dev);
	struct outcome outcome;

	if (!device)
		return 0;
	outcome = known_of(device, folder);
	return add_faults(run, device, 0, &outcome) &&
	       (asked >= 0 || outcome_best(&outcome, device_type_family(device->type)) < 0);
}

int outcome_choose(struct device *dev, int asked, const char *folder, const struct outcome_run *run)
{
	const struct device_description *device = device_describe(dev);
	const enum device_family preferred = device_family(dev);
	struct outcome outcome;
	size_t n_faults;
	int best;

	if (!device) {
		if (asked >= 0)
			device_choose_family(dev, (enum device_family)asked);
		return 0;
	}
	outcome = known_of(device, folder);
	n_faults = add_faults(run, device, 0, &outcome);
	if (asked >= 0)
		return take_asked(dev, (enum device_family)asked, &outcome, n_faults != 0);
	best = outcome_best(&outcome, preferred);
	if (best < 0)
		return refuse(dev, &outcome);
	if (!n_faults)
		say_choice(dev, preferred, (enum device_family)best, &outcome);
	device_choose_family(dev, (enum device_family)best);
	return 0;
}

int outcome_choose_known(struct device *dev)
{
	const struct outcome_run none = { .n = 0 };
	char folder[PATH_MAX];

	return outcome_choose(dev, -1, folder_cached("devices", folder, sizeof(folder)) ? folder : NULL, &none);
}
