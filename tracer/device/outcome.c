#include "tracer/device/outcome.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/kept.h"
#include "kernels/embed.h"

/* To be raised when a check looks at something else, or struct outcome changes. */
#define OUTCOME_VERSION 5

/* Two hashes that have nothing in common. */
static void mix(uint64_t key[2], const char *text)
{
	key[0] = XXH3_64bits_withSeed(text, strlen(text) + 1, key[0]);
	key[1] = XXH64(text, strlen(text) + 1, key[1]);
}

/* A device's file, by its name, and the key that its content must have. @return 0: the path is too long */
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
		err_warn(folder, "what was found out about devices is not kept there: %s", strerror(failed));
}

int outcome_fastest(const struct outcome *outcome)
{
	const struct outcome_family *f = outcome->families;
	int best = -1;

	for (int i = 0; i < N_DEVICE_FAMILIES; i++)
		if (f[i].state == OUTCOME_RIGHT && (best < 0 || f[i].frame_s < f[best].frame_s))
			best = i;
	return best;
}

const char *outcome_words(const struct outcome_family *family, char *text, size_t size)
{
	static const char *const words[N_OUTCOME_STATES] = { "right", "wrong", "failed", "not done in time", "not for this kind of device" };

	snprintf(text, size, family->where[0] ? "%s: %s" : "%s", words[family->state], family->where);
	return text;
}

int outcome_choose(struct device *dev, int asked, const char *folder)
{
	const struct device_description *device = device_describe(dev);
	const int known_by_kind = (int)device_family(dev), preferred = asked >= 0 ? asked : known_by_kind;
	struct outcome outcome;
	char text[96];
	int best;

	device_choose_family(dev, (enum device_family)preferred);
	if (!folder || !device || !outcome_read(folder, device, &outcome))
		return 0;
	outcome_words(&outcome.families[preferred], text, sizeof(text));
	if (asked >= 0) {
		if (outcome.families[asked].state != OUTCOME_RIGHT && outcome.families[asked].state != OUTCOME_PASSED_OVER)
			err_warn(device_name(dev), "--kernels %s is not right here, by 'relume devices --check' (%s)",
			         device_family_names[asked], text);
		return 0;
	}
	best = outcome_fastest(&outcome);
	if (best < 0)
		return err_report(ERR_SYSTEM, device_name(dev), "no kernels are right on this device, by 'relume devices --check' (%s %s): "
		                  "choose another --device, or --device reference (slow)", device_family_names[preferred], text);
	if (outcome.families[preferred].state != OUTCOME_RIGHT)
		err_warn(device_name(dev), "renders with --kernels %s: %s kernels are not right here, by 'relume devices --check' (%s)",
		         device_family_names[best], device_family_names[preferred], text);
	device_choose_family(dev, (enum device_family)best);
	return 0;
}
