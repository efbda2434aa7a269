/* Reads the rules' findings from a frame's attributes, and paints them. */
#include "diff/report/roles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/frames.h"

/* Take a field up to a tab. @return the text after it */
static const char *take(const char *text, char *out, size_t room)
{
	const size_t n = strcspn(text, "\t");

	snprintf(out, room, "%.*s", (int)n, text);
	return text[n] ? text + n + 1 : text + n;
}

int roles_read(const struct picture_frame *frame, unsigned i, struct role *out)
{
	char name[32], kind[16];
	const char *text;

	snprintf(name, sizeof(name), "relume:rule.%u", i);
	text = image_attribute(&frame->image, name);
	if (!text)
		return 0;
	text = take(text, kind, sizeof(kind));
	text = take(text, out->role, sizeof(out->role));
	text = take(text, out->confidence, sizeof(out->confidence));
	text = take(text, out->what, sizeof(out->what));
	take(text, out->why, sizeof(out->why));
	out->is_light = strcmp(kind, "light") == 0;
	return 1;
}

static int is_list(const char *text)
{
	return *text && strspn(text, "0123456789-,") == strlen(text);
}

/* Paint the role's draws as they are, and the rest at a fifth. */
static int paint_surface(const struct picture_frame *f, const struct role *role, uint8_t *rgb, size_t n)
{
	struct frame_list draws = { .n_ranges = 0 };
	int err = is_list(role->what) ? frame_list_parse(role->what, &draws) : 0;

	for (size_t i = 0; i < n && !err; i++) {
		const int has = draws.n_ranges && f->compared.id[i] >= 1 && f->compared.id[i] < 1e9f &&
		                frame_list_contains(&draws, (uint64_t)f->compared.id[i]);

		for (size_t c = 3 * i; c < 3 * i + 3; c++)
			rgb[c] = has ? f->compared.rgb[c] : f->compared.rgb[c] / 5;
		if (has)
			rgb[3 * i] = (uint8_t)(rgb[3 * i] < 205 ? rgb[3 * i] + 50 : 255); /* make black surfaces visible */
	}
	frame_list_free(&draws);
	return err;
}

/* Paint how much each pixel faces the light. */
static void paint_light(const float at[4], const float *const normal[3], const float *const place[3], uint8_t *rgb,
                        size_t n)
{
	for (size_t i = 0; i < n; i++) {
		float to[3], cosine = 0, square = 0;

		for (int k = 0; k < 3; k++) {
			to[k] = at[3] != 0 ? at[k] / at[3] - place[k][i] : at[k];
			square += to[k] * to[k];
			cosine += to[k] * normal[k][i];
		}
		cosine = square > 0 ? cosine / sqrtf(square) : 0;
		memset(rgb + 3 * i, (int)(255 * fminf(fmaxf(cosine, 0), 1)), 3);
	}
}

int roles_paint(const struct picture_frame *f, const struct role *role, uint8_t **rgb)
{
	const size_t n = (size_t)f->image.width * f->image.height;
	const float *normal[3] = { image_channel(&f->image, "N.X"), image_channel(&f->image, "N.Y"),
		                   image_channel(&f->image, "N.Z") };
	const float *place[3] = { image_channel(&f->image, "P.X"), image_channel(&f->image, "P.Y"),
		                  image_channel(&f->image, "P.Z") };
	float at[4];
	int err = 0;

	*rgb = NULL;
	if (role->is_light ? sscanf(role->what, "%f %f %f %f", &at[0], &at[1], &at[2], &at[3]) != 4 || !normal[2] ||
	                             !place[2] || !normal[0] || !place[0] :
	                     !f->compared.id)
		return 0;
	*rgb = malloc(3 * n + 1);
	if (!*rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (role->is_light)
		paint_light(at, normal, place, *rgb, n);
	else
		err = paint_surface(f, role, *rgb, n);
	if (err) {
		free(*rgb);
		*rgb = NULL;
	}
	return err;
}
