/* Makes a report's pictures of one frame. */
#include "diff/report/pictures.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/flip.h"
#include "diff/score/pair.h"

#define DIFFERENCE_GAIN 8

const char *const picture_names[N_PICTURES] = {
	"approved", "change", "changed", "reference", "compared", "beauty", "difference", "flip", "failing", "shadow",
	"relight", "reflect", "refract", "albedo", "normal", "depth", "id",
};

int picture_take_reference(const struct image *img, const char *channel, struct score_picture *out)
{
	const char *layers[] = { channel ? channel : "gl", "gl", "beauty" };
	int err = ERR_INPUT, has_layers = 0;

	for (size_t i = 0; channel && !image_attribute(img, "relume:record") && i < img->n_channels; i++)
		has_layers |= strchr(img->channels[i].name, '.') != NULL;
	/* in a picture with layers, plain colours do not replace the requested one; a recorded frame has colours alone */
	for (size_t i = 0; err == ERR_INPUT && i < sizeof(layers) / sizeof(layers[0]) - (size_t)has_layers; i++)
		err = score_picture_from_image(img, layers[i], out);
	return err;
}

/* Read the reference and the layer compared with it. */
static int take_reference(struct picture_frame *out)
{
	const char *channel = out->settings.options.channel;
	int err = picture_take_reference(&out->ref_image, channel, &out->ref);

	if (!err)
		err = score_picture_from_image(&out->image, channel ? channel : "gl", &out->compared);
	if (err == ERR_INPUT && out->ref.rgb && !channel) {
		out->is_beauty = 1;
		err = score_picture_from_image(&out->image, "beauty", &out->compared);
	}
	out->ref.ignore = out->settings.ignore;
	if (!err)
		err = score_pair(&out->ref, &out->compared, out->settings.options.ignore_alpha);
	if (!err && out->ref.width == out->compared.width && out->ref.height == out->compared.height)
		err = score_make_maps(&out->ref, &out->compared, &out->settings.options, &out->maps);
	return err;
}

int picture_frame_read(const struct picture_sources *from, uint64_t frame, struct picture_frame *out)
{
	const struct output_run *run = from->run;
	const struct set_entry *r = set_find(from->ref, frame), *t = set_find(from->traced, frame);
	int err = t && (r || from->baseline->dir) ? 0 : ERR_INPUT;
	const struct image *sized = r ? &out->ref_image : &out->image;

	if (!err && r)
		err = set_read(from->ref, r, &out->ref_image);
	if (!err)
		err = set_read(from->traced, t, &out->image);
	if (!err)
		err = score_rules_for_frame(run->settings, run->name, frame, run->options,
		                            (uint32_t[]){ sized->width, sized->height }, &out->settings);
	if (!err)
		err = score_rules_ignore_outside(&out->settings, sized->outside, (size_t)sized->width * sized->height);
	if (!err && sized->width == out->image.width && sized->height == out->image.height)
		err = score_rules_ignore_outside(&out->settings, out->image.outside, (size_t)sized->width * sized->height);
	out->ref.width = sized->width;
	out->ref.height = sized->height;
	if (!err && r)
		err = take_reference(out);
	if (!err && from->baseline->dir)
		err = change_find(from->baseline, &out->image, frame, out->settings.ignore, &out->change);
	return err;
}

void picture_frame_free(struct picture_frame *frame)
{
	change_free(&frame->change);
	score_maps_free(&frame->maps);
	score_rules_frame_free(&frame->settings);
	score_picture_free(&frame->compared);
	score_picture_free(&frame->ref);
	image_free(&frame->image);
	image_free(&frame->ref_image);
}

static int is_one_color(const uint8_t *rgb, size_t n)
{
	for (size_t i = 1; i < n; i++)
		if (memcmp(rgb, rgb + 3 * i, 3) != 0)
			return 0;
	return 1;
}

static void fill_difference(const struct score_picture *a, const struct score_picture *b, uint8_t *rgb, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		const int alpha = score_alpha_difference(a, i, b, i);

		for (size_t c = 3 * i; c < 3 * i + 3; c++) {
			const int colour = score_code_at(a, c) - score_code_at(b, c);
			const int d = DIFFERENCE_GAIN * (abs(colour) > alpha ? abs(colour) : alpha);

			rgb[c] = (uint8_t)(d < 255 ? d : 255);
		}
	}
}

/* Mark pixels in red over a dimmed grey picture, so that red objects do not look marked. */
static void fill_marked(const struct score_picture *under, const uint8_t *marked, uint8_t *rgb, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		const uint8_t *from = under->rgb + 3 * i;

		memset(rgb + 3 * i, (from[0] + 2 * from[1] + from[2]) / 12, 3);
		if (marked[i])
			memcpy(rgb + 3 * i, (uint8_t[]){ 255, 40, 30 }, 3);
	}
}

static int fill_flip(const struct picture_frame *f, uint8_t *rgb, size_t n)
{
	float *error = malloc((n ? n : 1) * sizeof(*error));
	double mean;
	int err = error ? flip_compare(f->ref.rgb, f->compared.rgb, f->ref.width, f->ref.height, error, &mean)
	                : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; !err && i < n; i++)
		flip_magma(error[i], rgb + 3 * i);
	free(error);
	return err;
}

static void fill_failing(const struct picture_frame *f, uint8_t *rgb, size_t n)
{
	fill_marked(&f->ref, f->maps.failing, rgb, n);
	for (size_t i = 0; i < n; i++)
		if (f->maps.band[i] && !f->maps.failing[i])
			rgb[3 * i + 2] = (uint8_t)(rgb[3 * i + 2] + 110);
}

static void fill_normal(const float *const planes[3], uint8_t *rgb, size_t n)
{
	for (size_t i = 0; i < n; i++)
		for (int c = 0; c < 3; c++) {
			float v = 127.5f + 127.5f * planes[c][i];

			rgb[3 * i + (size_t)c] = (uint8_t)(v > 0 ? v < 255 ? v : 255 : 0);
		}
}

/* Grey from black (far, and the background) to white (near), linear between the frame's extremes. */
static void fill_depth(const float *depth, uint8_t *rgb, size_t n)
{
	float lo = 1, hi = 0;

	for (size_t i = 0; i < n; i++) {
		if (depth[i] < lo)
			lo = depth[i];
		if (depth[i] < 1 && depth[i] > hi)
			hi = depth[i];
	}
	for (size_t i = 0; i < n; i++) {
		float v = depth[i] < 1 ? hi > lo ? 255 - 215 * (depth[i] - lo) / (hi - lo) : 255 : 0;

		memset(rgb + 3 * i, (int)(v > 0 ? v < 255 ? v : 255 : 0), 3);
	}
}

static void fill_id(const float *id, uint8_t *rgb, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		/* Knuth's multiplicative hash: adjacent numbers get distant colours. */
		uint32_t h = (uint32_t)(id[i] > 0 && id[i] < 1e9f ? id[i] : 0) * 2654435761u;

		rgb[3 * i] = h ? (uint8_t)(64 + (h >> 24) % 192) : 0;
		rgb[3 * i + 1] = h ? (uint8_t)(64 + (h >> 16) % 192) : 0;
		rgb[3 * i + 2] = h ? (uint8_t)(64 + (h >> 8) % 192) : 0;
	}
}

/** A colour layer of the traced frame; `effect` layers without any effect are omitted. */
static int make_layer(const struct picture_frame *f, const char *layer, int effect, uint8_t **rgb)
{
	struct score_picture picture = { 0 };
	int err = score_picture_from_image(&f->image, layer, &picture);

	if (err)
		return err == ERR_INPUT ? 0 : err;
	if (effect && is_one_color(picture.rgb, (size_t)picture.width * picture.height)) {
		score_picture_free(&picture);
		return 0;
	}
	*rgb = picture.rgb;
	return 0;
}

static int make_copy(const struct score_picture *picture, uint8_t **rgb, uint32_t *width, uint32_t *height)
{
	const size_t n = (size_t)picture->width * picture->height;

	if (!picture->rgb)
		return 0;
	*width = picture->width;
	*height = picture->height;
	*rgb = malloc(n ? 3 * n : 1);
	if (!*rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	memcpy(*rgb, picture->rgb, 3 * n);
	return 0;
}

/** Pictures computed into a new buffer. */
static int make_map(const struct picture_frame *f, enum picture_kind kind, uint8_t **rgb)
{
	const size_t n = (size_t)f->image.width * f->image.height;
	const float *normal[3] = { image_channel(&f->image, "N.X"), image_channel(&f->image, "N.Y"),
	                           image_channel(&f->image, "N.Z") };
	uint8_t *out;
	int err = 0;

	const int is_of_change = kind == PICTURE_CHANGE || kind == PICTURE_CHANGED;

	if ((is_of_change && !f->change.off) || (!is_of_change && kind <= PICTURE_FAILING && !f->maps.failing) ||
	    (kind == PICTURE_DEPTH && !f->compared.depth) || (kind == PICTURE_ID && !f->compared.id) ||
	    (kind == PICTURE_NORMAL && !(normal[0] && normal[1] && normal[2])))
		return 0;
	out = malloc(n ? 3 * n : 1);
	if (!out)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	switch (kind) {
	case PICTURE_CHANGE: fill_difference(&f->change.was, &f->change.now, out, n); break;
	case PICTURE_CHANGED: fill_marked(&f->change.was, f->change.off, out, n); break;
	case PICTURE_DIFFERENCE: fill_difference(&f->ref, &f->compared, out, n); break;
	case PICTURE_FLIP: err = fill_flip(f, out, n); break;
	case PICTURE_FAILING: fill_failing(f, out, n); break;
	case PICTURE_NORMAL: fill_normal(normal, out, n); break;
	case PICTURE_DEPTH: fill_depth(f->compared.depth, out, n); break;
	default: fill_id(f->compared.id, out, n);
	}
	if (err) {
		free(out);
		return err;
	}
	*rgb = out;
	return 0;
}

int picture_make(const struct picture_frame *f, enum picture_kind kind, uint8_t **rgb, uint32_t *width,
                 uint32_t *height)
{
	*rgb = NULL;
	*width = f->image.width;
	*height = f->image.height;
	switch (kind) {
	case PICTURE_APPROVED: return make_copy(&f->change.was, rgb, width, height);
	case PICTURE_REFERENCE: return make_copy(&f->ref, rgb, width, height);
	case PICTURE_COMPARED: return make_copy(&f->compared, rgb, width, height);
	case PICTURE_BEAUTY: return f->is_beauty ? 0 : make_layer(f, "beauty", 0, rgb);
	case PICTURE_SHADOW: return make_layer(f, "shadow", 1, rgb);
	case PICTURE_RELIGHT: return make_layer(f, "relight", 1, rgb);
	case PICTURE_REFLECT: return make_layer(f, "reflect", 1, rgb);
	case PICTURE_REFRACT: return make_layer(f, "refract", 1, rgb);
	case PICTURE_ALBEDO: return make_layer(f, "albedo", 1, rgb);
	default: return make_map(f, kind, rgb);
	}
}
