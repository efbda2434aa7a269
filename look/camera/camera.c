#include "look/camera/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/config.h"
#include "base/err.h"

#define OPTIONAL_POINTER (CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL)
#define NUMBER(type, name) CYAML_FIELD_FLOAT_PTR(#name, OPTIONAL_POINTER, type, name)
#define VECTOR(type, name) CYAML_FIELD_SEQUENCE_FIXED(#name, OPTIONAL_POINTER, type, name, &number, 3)
#define TEXT(type, name) CYAML_FIELD_STRING_PTR(#name, OPTIONAL_POINTER, type, name, 1, 32)

static const cyaml_schema_value_t number = { CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, float) };
static const cyaml_schema_value_t count = { CYAML_VALUE_UINT(CYAML_FLAG_DEFAULT, uint32_t) };

static const cyaml_schema_field_t turntable_fields[] = {
	VECTOR(struct camera_turntable, about), NUMBER(struct camera_turntable, degrees),
	CYAML_FIELD_UINT_PTR("frames", OPTIONAL_POINTER, struct camera_turntable, frames), CYAML_FIELD_END
};

static const cyaml_schema_field_t camera_fields[] = {
	TEXT(struct camera_keys, kind),
	TEXT(struct camera_keys, space),
	VECTOR(struct camera_keys, place),
	VECTOR(struct camera_keys, look_at),
	VECTOR(struct camera_keys, up),
	NUMBER(struct camera_keys, field_of_view),
	NUMBER(struct camera_keys, height),
	NUMBER(struct camera_keys, near),
	NUMBER(struct camera_keys, far),
	NUMBER(struct camera_keys, aperture),
	NUMBER(struct camera_keys, focus),
	NUMBER(struct camera_keys, eyes),
	NUMBER(struct camera_keys, converge),
	CYAML_FIELD_SEQUENCE_FIXED("size", OPTIONAL_POINTER, struct camera_keys, size, &count, 2),
	CYAML_FIELD_MAPPING_PTR("turntable", OPTIONAL_POINTER, struct camera_keys, turntable, turntable_fields),
	CYAML_FIELD_END
};

static const cyaml_schema_value_t camera_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct camera_keys,
	                                                                camera_fields) };

/* --- Checks beyond libcyaml's ------------------------------------------------------------------------------------ */

static int is_word(const char *value, const char *one, const char *other)
{
	return !value || strcmp(value, one) == 0 || strcmp(value, other) == 0;
}

/* Check that n numbers are between two bounds. */
static int check_numbers(const char *path, const char *key, const float *values, int n, float least, float most)
{
	for (int i = 0; values && i < n; i++)
		if (!(values[i] >= least && values[i] <= most))
			return err_report(ERR_INPUT, path, "%s is %g; it must be between %g and %g", key,
			                  (double)values[i], (double)least, (double)most);
	return 0;
}

static int is_zero(const float v[3])
{
	return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static int check_turntable(const char *path, const struct camera_keys *k)
{
	const struct camera_turntable *t = k->turntable;
	int err = check_numbers(path, "turntable: about", t->about, 3, -1e30f, 1e30f);

	if (!err)
		err = check_numbers(path, "turntable: degrees", t->degrees, 1, -1e6f, 1e6f);
	if (!err && k->look_at)
		err = err_report(ERR_INPUT, path, "look_at cannot be used with turntable, which looks at 'about'");
	if (!err && t->frames && (!*t->frames || *t->frames > CAMERA_MOST_PICTURES))
		err = err_report(ERR_INPUT, path, "turntable: frames is %u; it must be between 1 and %d", *t->frames,
		                 CAMERA_MOST_PICTURES);
	return err;
}

static int check_places(const char *path, const struct camera_keys *k)
{
	int err = check_numbers(path, "place", k->place, 3, -1e30f, 1e30f);

	if (!err)
		err = check_numbers(path, "look_at", k->look_at, 3, -1e30f, 1e30f);
	if (!err)
		err = check_numbers(path, "up", k->up, 3, -1e30f, 1e30f);
	if (!err && k->up && is_zero(k->up))
		err = err_report(ERR_INPUT, path, "up must not be 0 0 0");
	if (!err && k->place && k->look_at && memcmp(k->place, k->look_at, 3 * sizeof(*k->place)) == 0)
		err = err_report(ERR_INPUT, path, "look_at must differ from place");
	return err;
}

int camera_is_kind(const struct camera_keys *k, const char *kind)
{
	return k->kind && strcmp(k->kind, kind) == 0;
}

static int check_kind(const char *path, const struct camera_keys *k)
{
	static const char *const kinds[] = { "pinhole", "orthographic", "panorama", "cube", "stereo" };
	int known = !k->kind;

	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]) && !known; i++)
		known = camera_is_kind(k, kinds[i]);
	if (!known)
		return err_report(ERR_INPUT, path,
		                  "kind must be pinhole, orthographic, panorama, cube or stereo, not '%s'", k->kind);
	if (k->field_of_view && k->height)
		return err_report(ERR_INPUT, path, "field_of_view and height cannot be used together");
	if (k->field_of_view && k->kind && !camera_is_kind(k, "pinhole") && !camera_is_kind(k, "stereo"))
		return err_report(ERR_INPUT, path, "field_of_view cannot be used with kind %s", k->kind);
	if (k->height && k->kind && !camera_is_kind(k, "orthographic"))
		return err_report(ERR_INPUT, path, "height cannot be used with kind %s", k->kind);
	return 0;
}

/* Check the keys that only cameras of look/camera/lens.h use. */
static int check_lens(const char *path, const struct camera_keys *k)
{
	int err = check_numbers(path, "aperture", k->aperture, 1, 0, 1e30f);

	if (!err)
		err = check_numbers(path, "focus", k->focus, 1, 1e-30f, 1e30f);
	if (!err)
		err = check_numbers(path, "eyes", k->eyes, 1, 0, 1e30f);
	if (!err)
		err = check_numbers(path, "converge", k->converge, 1, 1e-30f, 1e30f);
	if (!err && !k->aperture != !k->focus)
		err = err_report(ERR_INPUT, path, "aperture and focus need each other; one of them is missing");
	if (!err && k->aperture && ((k->kind && !camera_is_kind(k, "pinhole")) || k->height))
		err = err_report(ERR_INPUT, path, "aperture needs kind pinhole");
	if (!err && k->eyes && !camera_is_kind(k, "stereo") && !camera_is_kind(k, "panorama"))
		err = err_report(ERR_INPUT, path, "eyes needs kind stereo or panorama");
	if (!err && k->converge && !camera_is_kind(k, "stereo"))
		err = err_report(ERR_INPUT, path, "converge needs kind stereo");
	return !err && camera_is_kind(k, "stereo") && !k->eyes ?
	               err_report(ERR_INPUT, path, "kind stereo needs eyes, the distance between them") :
	               err;
}

static int check_all(const char *path, const struct camera_keys *k)
{
	int err = check_places(path, k);

	if (!err)
		err = check_kind(path, k);
	if (!err)
		err = check_lens(path, k);
	if (!err && !is_word(k->space, "eye", "world"))
		err = err_report(ERR_INPUT, path, "space must be eye or world, not '%s'", k->space);
	if (!err)
		err = check_numbers(path, "field_of_view", k->field_of_view, 1, 0.01f, 179);
	if (!err)
		err = check_numbers(path, "height", k->height, 1, 1e-30f, 1e30f);
	if (!err)
		err = check_numbers(path, "near", k->near, 1, -1e30f, 1e30f);
	if (!err)
		err = check_numbers(path, "far", k->far, 1, -1e30f, 1e30f);
	if (!err && k->near && k->far && !(*k->near < *k->far))
		err = err_report(ERR_INPUT, path, "near is %g but far is %g; far must be larger",
		                 (double)*k->near, (double)*k->far);
	for (int i = 0; i < 2 && !err && k->size; i++)
		if (!k->size[i] || k->size[i] > CAMERA_MOST_SIZE)
			err = err_report(ERR_INPUT, path, "size is %u x %u; each must be between 1 and %d", k->size[0],
			                 k->size[1], CAMERA_MOST_SIZE);
	return err || !k->turntable ? err : check_turntable(path, k);
}

/* --- The file ---------------------------------------------------------------------------------------------------- */

int camera_load(const char *path, struct camera **out)
{
	struct camera *camera = calloc(1, sizeof(*camera));
	void *data = NULL;
	int err = camera ? config_load(path, &camera_schema, &data) : err_report(ERR_SYSTEM, NULL, "out of memory");

	*out = NULL;
	if (err) {
		free(camera);
		return err;
	}
	*camera = (struct camera){ path, data };
	err = check_all(path, camera->keys);
	if (err)
		camera_free(&camera);
	*out = camera;
	return err;
}

void camera_free(struct camera **camera)
{
	if (!*camera)
		return;
	config_free(&camera_schema, (*camera)->keys);
	free(*camera);
	*camera = NULL;
}

uint32_t camera_pictures(const struct camera *camera)
{
	const struct camera_turntable *t = camera ? camera->keys->turntable : NULL;

	return !t ? 0 : t->frames ? *t->frames : 48;
}

int camera_is_in_world(const struct camera *camera)
{
	return camera->keys->space && strcmp(camera->keys->space, "world") == 0;
}
