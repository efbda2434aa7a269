#include "verbs/render/surfaces.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base64.h"
#include "base/err.h"
#include "base/folder.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/part.h"
#include "gl_tokens.h"
#include "look/apply/alone.h"
#include "scene/describe.h"
#include "scene/drawn.h"
#include "scene/png_pack.h"
#include "scene/tokens.h"
#include "tracer/image/display.h"

#define DATA_MARKER "/*DATA*/"
#define SURFACE_BYTES 4096 /* room for the facts about one */

struct page {
	const struct single *single;
	uint32_t *owners;   /* [pixels]: 1 + the instance that it shows; 0: none */
	uint32_t *surfaces; /* [n_instances + 1], by that: 1 + its place among those seen; 0: not seen */
	struct json json;
};

/* --- What is seen where ------------------------------------------------------------------------------------------ */

static int find_owners(struct page *p)
{
	const struct image *img = &p->single->image;
	const size_t n = (size_t)img->width * img->height;
	uint32_t seen = 0;

	p->owners = malloc((n + 1) * sizeof(*p->owners));
	p->surfaces = calloc(p->single->scene->n_instances + (size_t)1, sizeof(*p->surfaces));
	if (!p->owners || !p->surfaces)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < n; i++) {
		const uint32_t draw = single_draw_at(p->single, i),
			       instance = draw ? scene_instance_of(p->single->scene, draw) : SCENE_NONE;

		p->owners[i] = instance == SCENE_NONE ? 0 : instance + 1;
		if (p->owners[i])
			p->surfaces[p->owners[i]] = 1;
	}
	for (uint32_t k = 1; k <= p->single->scene->n_instances; k++)
		p->surfaces[k] = p->surfaces[k] ? ++seen : 0;
	return 0;
}

/* Pixels as pairs of a surface and how many pixels in a row show it. */
static int write_runs(struct page *p)
{
	const struct image *img = &p->single->image;
	const size_t n = (size_t)img->width * img->height;
	uint32_t *runs = malloc((2 * n + 1) * sizeof(*runs));
	size_t length = 0;

	if (!runs)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0, first = 0; i < n; i++) {
		if (i + 1 < n && p->owners[i + 1] == p->owners[first])
			continue;
		runs[length++] = p->surfaces[p->owners[first]];
		runs[length++] = (uint32_t)(i + 1 - first);
		first = i + 1;
	}
	json_key_uints(&p->json, "runs", runs, length);
	free(runs);
	return 0;
}

/* --- Pictures ---------------------------------------------------------------------------------------------------- */

static int write_png(struct page *p, uint8_t *png, size_t n)
{
	char *url = base64_url("image/png", png, n);

	if (url)
		json_key_string(&p->json, "picture", url);
	free(url);
	free(png);
	return url ? 0 : ERR_SYSTEM;
}

static int write_frame(struct page *p)
{
	const struct image *img = &p->single->image;
	uint8_t *rgb = malloc((size_t)img->width * img->height * 3 + 1), *png = NULL;
	struct display *display = NULL;
	size_t n = 0;
	int err = rgb ? display_create(&(struct display_options){ .white = 1, .rounds = 1 }, &display) :
	                err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		err = display_codes(display, img, "", rgb, NULL);
	if (!err)
		err = png_pack(&(struct png_pixels){ rgb, img->width, img->height, 3 * (size_t)img->width, 0 }, &png, &n);
	display_destroy(&display);
	free(rgb);
	return err ? err : write_png(p, png, n);
}

/* --- Surfaces, textures, meshes ---------------------------------------------------------------------------------- */

static int write_surface(struct page *p, uint32_t instance)
{
	const struct scene *s = p->single->scene;
	const struct scene_instance *in = &s->instances[instance];
	const struct scene_material *m = &s->materials[in->material];
	char keys[ALONE_BYTES], facts[SURFACE_BYTES] = "", name[64];
	const int others = alone_find(s, instance, keys);
	FILE *out = others < 0 ? NULL : fmemopen(facts, sizeof(facts), "w");

	if (!out)
		return others < 0 ? others : err_report(ERR_SYSTEM, NULL, "out of memory");
	scene_describe(out, s, instance, "");
	if (others)
		fprintf(out, "without `draws` the rule matches %d more; draw numbers hold in this frame alone", others);
	fclose(out);
	snprintf(name, sizeof(name), "draw %u: %.40s", in->draw, s->draws[in->draw].call);
	json_begin(&p->json, '{');
	json_key_string(&p->json, "name", name);
	json_key_string(&p->json, "facts", facts);
	json_key_string(&p->json, "keys", keys);
	json_key_uints(&p->json, "meshes", &in->mesh, 1);
	json_key_begin(&p->json, "textures", '[');
	for (uint32_t i = 0; i < m->unit_count; i++)
		json_uint(&p->json, s->units[m->unit_first + i].texture);
	json_end(&p->json, ']');
	json_end(&p->json, '}');
	return 0;
}

static void write_hash(struct page *p, const uint64_t hash[2])
{
	char text[33];

	hash_text(hash, text);
	json_key_string(&p->json, "hash", text);
}

static int write_texture(struct page *p, const struct scene_texture *t)
{
	char about[2 * TOKEN_NAME_BYTES], format[TOKEN_NAME_BYTES];
	uint8_t *png = NULL;
	size_t n;
	int err = 0;

	snprintf(about, sizeof(about), "%u x %u %s", t->width, t->height, token_name(t->base_format, format));
	json_begin(&p->json, '{');
	write_hash(p, t->hash);
	json_key_string(&p->json, "about", about);
	if (t->base_format == GL_DEPTH_COMPONENT)
		json_key_string(&p->json, "picture", "");
	else
		err = png_pack_texture(t, &png, &n);
	if (png)
		err = write_png(p, png, n);
	json_end(&p->json, '}');
	return err;
}

static void write_mesh(struct page *p, const struct scene_mesh *m)
{
	static const char *const kinds[] = { "", "points", "lines", "triangles" };
	char about[64];

	snprintf(about, sizeof(about), "%u %s%s", m->primitive_count, kinds[m->kind], m->normal ? ", with normals" : "");
	json_begin(&p->json, '{');
	write_hash(p, m->hash);
	json_key_string(&p->json, "about", about);
	json_key_string(&p->json, "picture", "");
	json_end(&p->json, '}');
}

static int write_lists(struct page *p)
{
	const struct scene *s = p->single->scene;
	int err = 0;

	json_key_begin(&p->json, "surfaces", '[');
	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		err = p->surfaces[i + 1] ? write_surface(p, i) : 0;
	json_end(&p->json, ']');
	json_key_begin(&p->json, "textures", '[');
	for (uint32_t i = 0; i < s->n_textures && !err; i++)
		err = write_texture(p, s->textures[i]);
	json_end(&p->json, ']');
	json_key_begin(&p->json, "meshes", '[');
	for (uint32_t i = 0; i < s->n_meshes; i++)
		write_mesh(p, s->meshes[i]);
	json_end(&p->json, ']');
	return err;
}

static int write_data(struct page *p, const char *trace)
{
	const struct image *img = &p->single->image;
	int err = find_owners(p);

	json_begin(&p->json, '{');
	json_key_string(&p->json, "trace", trace);
	json_key_uint(&p->json, "frame", p->single->scene->frame);
	json_key_uint(&p->json, "width", img->width);
	json_key_uint(&p->json, "height", img->height);
	if (!err)
		err = write_runs(p);
	if (!err)
		err = write_frame(p);
	if (!err)
		err = write_lists(p);
	json_end(&p->json, '}');
	return err;
}

int surfaces_write(const struct single *single, const char *trace, const char *path)
{
	const char *marker = strstr(surfaces_page, DATA_MARKER);
	struct page page = { .single = single };
	struct part_file file;
	int err = folder_make_for(path);

	if (!err)
		err = part_open(&file, path);
	if (err)
		return err;
	page.json.out = file.stream;
	fwrite(surfaces_page, 1, (size_t)(marker - surfaces_page), file.stream);
	err = write_data(&page, trace);
	fputs(marker + strlen(DATA_MARKER), file.stream);
	free(page.owners);
	free(page.surfaces);
	return part_close(&file, err);
}
