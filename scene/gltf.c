/* Writes a glTF file: its JSON, then the binary chunk. */
#include "scene/gltf_parts.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "base/json.h"
#include "base/mat4.h"

#define PI 3.14159265358979323846

static void json_extension(struct json *j, const char *name, const char *key, float value)
{
	json_key_begin(j, name, '{');
	if (key)
		json_key_float(j, key, (double)value);
	json_end(j, '}');
}

static void write_look(struct json *j, const struct gltf_look *l)
{
	json_begin(j, '{');
	json_key_begin(j, "pbrMetallicRoughness", '{');
	json_key_floats(j, "baseColorFactor", l->base, 4);
	json_key_float(j, "metallicFactor", (double)l->metallic);
	json_key_float(j, "roughnessFactor", (double)l->roughness);
	if (l->texture != SCENE_NONE) {
		json_key_begin(j, "baseColorTexture", '{');
		json_key_uint(j, "index", l->texture);
		json_end(j, '}');
	}
	json_end(j, '}');
	if (l->emissive[0] + l->emissive[1] + l->emissive[2] > 0)
		json_key_floats(j, "emissiveFactor", l->emissive, 3);
	if (l->blend || l->mask)
		json_key_string(j, "alphaMode", l->blend ? "BLEND" : "MASK");
	if (l->mask)
		json_key_float(j, "alphaCutoff", (double)l->cutoff);
	json_key_bool(j, "doubleSided", (int)l->double_sided);
	if (l->unlit || l->transmission > 0) {
		json_key_begin(j, "extensions", '{');
		if (l->unlit)
			json_extension(j, "KHR_materials_unlit", NULL, 0);
		if (l->transmission > 0) {
			json_extension(j, "KHR_materials_transmission", "transmissionFactor", l->transmission);
			json_extension(j, "KHR_materials_ior", "ior", l->ior);
		}
		json_end(j, '}');
	}
	json_end(j, '}');
}

static void write_accessor(struct json *j, const struct gltf_accessor *a)
{
	json_begin(j, '{');
	json_key_uint(j, "bufferView", a->piece);
	json_key_uint(j, "componentType", a->component);
	json_key_uint(j, "count", a->count);
	json_key_string(j, "type", a->type);
	if (a->has_bounds) {
		json_key_floats(j, "min", a->min, 3);
		json_key_floats(j, "max", a->max, 3);
	}
	json_end(j, '}');
}

static void write_piece(struct json *j, const struct gltf_piece *p)
{
	json_begin(j, '{');
	json_key_uint(j, "buffer", 0);
	json_key_uint(j, "byteOffset", p->offset);
	json_key_uint(j, "byteLength", p->n_bytes);
	if (p->target)
		json_key_uint(j, "target", p->target);
	json_end(j, '}');
}

static void write_mesh(struct json *j, const struct gltf *g, const struct gltf_part *p)
{
	static const uint32_t modes[] = { 0, GL_POINTS, GL_LINES, GL_TRIANGLES };
	static const char *const names[] = { "POSITION", "NORMAL", "COLOR_0", "TEXCOORD_0" };
	const uint32_t accessors[] = { p->position, p->normal, p->color, p->texcoord };

	json_begin(j, '{');
	json_key_begin(j, "primitives", '[');
	json_begin(j, '{');
	json_key_begin(j, "attributes", '{');
	for (int i = 0; i < 4; i++)
		if (accessors[i] != SCENE_NONE)
			json_key_uint(j, names[i], accessors[i]);
	json_end(j, '}');
	json_key_uint(j, "indices", p->index);
	json_key_uint(j, "mode", modes[g->s->meshes[p->mesh]->kind]);
	json_key_uint(j, "material", p->look);
	json_end(j, '}');
	json_end(j, ']');
	json_end(j, '}');
}

/* glTF has neither CLAMP nor CLAMP_TO_BORDER. */
static uint32_t wrap_of(uint32_t wrap)
{
	return wrap == GL_REPEAT || wrap == GL_MIRRORED_REPEAT ? wrap : GL_CLAMP_TO_EDGE;
}

static void write_sampler(struct json *j, const struct gltf_sampled *s)
{
	json_begin(j, '{');
	json_key_uint(j, "magFilter", s->mag_filter);
	json_key_uint(j, "minFilter", s->min_filter);
	json_key_uint(j, "wrapS", wrap_of(s->wrap_s));
	json_key_uint(j, "wrapT", wrap_of(s->wrap_t));
	json_end(j, '}');
}

static void write_camera(struct json *j, const struct scene_view *v)
{
	const float *p = v->projection;
	int perspective = gltf_camera_kind(p) == 1;
	const char *kind = perspective ? "perspective" : "orthographic";
	/* the inverse of Frustum and Ortho (GL 2.1 sec. 2.11.2) */
	float near = perspective ? p[14] / (p[10] - 1) : (p[14] + 1) / p[10];
	float far = perspective ? p[14] / (p[10] + 1) : (p[14] - 1) / p[10];

	json_begin(j, '{');
	json_key_string(j, "type", kind);
	json_key_begin(j, kind, '{');
	if (perspective) {
		json_key_float(j, "yfov", 2 * atan(1 / (double)p[5]));
		json_key_float(j, "aspectRatio", (double)(p[5] / p[0]));
	} else {
		json_key_float(j, "xmag", 1 / (double)p[0]);
		json_key_float(j, "ymag", 1 / (double)p[5]);
		far -= fminf(near, 0); /* glTF requires 0 <= near; geometry behind the viewer is lost */
		near = fmaxf(near, 0);
	}
	json_key_float(j, "znear", (double)near);
	if (isfinite(far) && far > near)
		json_key_float(j, "zfar", (double)far);
	json_end(j, '}');
	json_end(j, '}');
}

/*
 * Lumen per watt (at 555 nm): KHR_lights_punctual counts in candela and lux. Programs that render in watts divide by
 * this number again (Blender's importer, "standard" light units), so a radiance of 1 stays 1.
 */
#define LUMEN_PER_WATT 683.0

/* Write a light for KHR_lights_punctual: a white surface that faces it at the middle of its space gets its diffuse
 * colour. */
static void write_light(struct json *j, const struct scene_light *l, const float middle[3])
{
	float most = fmaxf(fmaxf(l->diffuse[0], l->diffuse[1]), fmaxf(l->diffuse[2], 1e-6f)), color[3];
	int positional = l->position_eye[3] != 0, spot = positional && l->spot_cutoff_deg <= 90;
	double intensity = LUMEN_PER_WATT * PI * (double)gltf_linear(most), d2 = 0;

	for (int i = 0; i < 3 && positional; i++) {
		double d = (double)(l->position_eye[i] / l->position_eye[3] - middle[i]);
		d2 += d * d;
	}
	if (positional) /* GL 2.1 eq. 2.4 has more terms than the inverse square */
		intensity *= d2 / ((double)l->attenuation[0] + (double)l->attenuation[1] * sqrt(d2) + (double)l->attenuation[2] * d2);
	for (int i = 0; i < 3; i++)
		color[i] = gltf_linear(l->diffuse[i] / most);
	json_begin(j, '{');
	json_key_string(j, "type", !positional ? "directional" : spot ? "spot" : "point");
	json_key_floats(j, "color", color, 3);
	json_key_float(j, "intensity", intensity);
	if (spot) {
		json_key_begin(j, "spot", '{');
		json_key_float(j, "outerConeAngle", (double)l->spot_cutoff_deg * PI / 180);
		json_end(j, '}');
	}
	json_end(j, '}');
}

/* Write a light's node: glTF's lights shine along their own -z. */
static void write_light_node(struct json *j, const struct scene_light *l, uint32_t number)
{
	float m[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, *x = m, *y = m + 4, *z = m + 8;
	int positional = l->position_eye[3] != 0;

	for (int i = 0; i < 3; i++) {
		z[i] = positional ? -l->spot_direction_eye[i] : l->position_eye[i];
		m[12 + i] = positional ? l->position_eye[i] / l->position_eye[3] : 0;
	}
	gltf_normalise(z);
	/* any axis perpendicular to z: that of the smallest component, turned */
	x[0] = fabsf(z[0]) < 0.9f ? 0 : -z[2];
	x[1] = fabsf(z[0]) < 0.9f ? z[2] : 0;
	x[2] = fabsf(z[0]) < 0.9f ? -z[1] : z[0];
	gltf_normalise(x);
	y[0] = z[1] * x[2] - z[2] * x[1];
	y[1] = z[2] * x[0] - z[0] * x[2];
	y[2] = z[0] * x[1] - z[1] * x[0];
	json_begin(j, '{');
	json_key_floats(j, "matrix", m, 16);
	json_key_begin(j, "extensions", '{');
	json_key_begin(j, "KHR_lights_punctual", '{');
	json_key_uint(j, "light", number);
	json_end(j, '}');
	json_end(j, '}');
	json_end(j, '}');
}

static void write_instance_node(struct json *j, const struct gltf *g, const struct gltf_node *n)
{
	const struct scene_instance *in = &g->s->instances[n->index];
	char name[64];

	snprintf(name, sizeof(name), "draw %u", in->draw);
	json_begin(j, '{');
	json_key_string(j, "name", name);
	json_key_uint(j, "mesh", n->part);
	if (g->parts[n->part].baked == SCENE_NONE && memcmp(in->modelview, mat4_identity, sizeof(in->modelview)) != 0)
		json_key_floats(j, "matrix", in->modelview, 16);
	json_end(j, '}');
}

static void write_nodes(struct json *j, const struct gltf *g)
{
	uint32_t cameras = 0, lights = 0;

	for (uint32_t i = 0; i < g->n_nodes; i++) {
		const struct gltf_node *n = &g->nodes[i];
		if (n->kind == GLTF_INSTANCE) {
			write_instance_node(j, g, n);
		} else if (n->kind == GLTF_LIGHT) {
			write_light_node(j, &g->s->lights[n->index], lights++);
		} else {
			json_begin(j, '{');
			json_key_uint(j, "camera", cameras++);
			json_end(j, '}');
		}
	}
}

/* Write cameras or lights in the order of their nodes. Empty arrays are not allowed (glTF 2.0 sec. 5.17). */
static void write_of_kind(struct json *j, const struct gltf *g, enum gltf_node_kind kind, const char *name)
{
	int any = 0;

	for (uint32_t s = 0; s < g->n_spaces; s++)
		for (uint32_t i = 0; i < g->spaces[s].node_count; i++) {
			const struct gltf_node *n = &g->nodes[g->spaces[s].node_first + i];
			if (n->kind != kind)
				continue;
			if (!any++) {
				json_key_begin(j, name, '[');
			}
			if (kind == GLTF_LIGHT)
				write_light(j, &g->s->lights[n->index], g->spaces[s].middle);
			else
				write_camera(j, &g->s->views[n->index]);
		}
	if (any)
		json_end(j, ']');
}

static void write_scenes(struct json *j, const struct gltf *g)
{
	uint32_t largest = 0;

	json_key_begin(j, "scenes", '[');
	for (uint32_t s = 0; s < g->n_spaces; s++) {
		if (g->spaces[s].n_primitives > g->spaces[largest].n_primitives)
			largest = s;
		json_begin(j, '{');
		json_key_begin(j, "nodes", '[');
		for (uint32_t i = 0; i < g->spaces[s].node_count; i++)
			json_uint(j, g->spaces[s].node_first + i);
		json_end(j, ']');
		json_end(j, '}');
	}
	json_end(j, ']');
	json_key_uint(j, "scene", largest);
}

static void write_extensions_used(struct json *j, const struct gltf *g)
{
	int lights = 0, unlit = 0, transmission = 0;

	for (uint32_t i = 0; i < g->n_nodes; i++)
		lights |= g->nodes[i].kind == GLTF_LIGHT;
	for (uint32_t i = 0; i < g->n_looks; i++) {
		unlit |= g->looks[i].unlit != 0;
		transmission |= g->looks[i].transmission > 0;
	}
	if (!lights && !unlit && !transmission)
		return;
	json_key_begin(j, "extensionsUsed", '[');
	if (lights)
		json_string(j, "KHR_lights_punctual");
	if (unlit)
		json_string(j, "KHR_materials_unlit");
	if (transmission) {
		json_string(j, "KHR_materials_transmission");
		json_string(j, "KHR_materials_ior");
	}
	json_end(j, ']');
	if (lights) {
		json_key_begin(j, "extensions", '{');
		json_key_begin(j, "KHR_lights_punctual", '{');
		write_of_kind(j, g, GLTF_LIGHT, "lights");
		json_end(j, '}');
		json_end(j, '}');
	}
}

#define LIST(name, n, write) \
	do { \
		if (!(n)) \
			break; \
		json_key_begin(j, name, '['); \
		for (uint32_t i = 0; i < (n); i++) \
			write; \
		json_end(j, ']'); \
	} while (0)

static void write_sampled(struct json *j, uint32_t i)
{
	json_begin(j, '{');
	json_key_uint(j, "sampler", i);
	json_key_uint(j, "source", i);
	json_end(j, '}');
}

static void write_image(struct json *j, const struct gltf_sampled *s)
{
	json_begin(j, '{');
	json_key_uint(j, "bufferView", s->piece);
	json_key_string(j, "mimeType", "image/png");
	json_end(j, '}');
}

static void write_text(struct json *j, const struct gltf *g)
{
	json_begin(j, '{');
	json_key_begin(j, "asset", '{');
	json_key_string(j, "version", "2.0");
	json_key_string(j, "generator", "relume");
	json_end(j, '}');
	write_extensions_used(j, g);
	write_scenes(j, g);
	json_key_begin(j, "nodes", '[');
	write_nodes(j, g);
	json_end(j, ']');
	write_of_kind(j, g, GLTF_CAMERA, "cameras");
	LIST("meshes", g->n_parts, write_mesh(j, g, &g->parts[i]));
	LIST("materials", g->n_looks, write_look(j, &g->looks[i]));
	LIST("textures", g->n_sampled, write_sampled(j, i));
	LIST("images", g->n_sampled, write_image(j, &g->sampled[i]));
	LIST("samplers", g->n_sampled, write_sampler(j, &g->sampled[i]));
	LIST("accessors", g->n_accessors, write_accessor(j, &g->accessors[i]));
	LIST("bufferViews", g->n_pieces, write_piece(j, &g->pieces[i]));
	json_key_begin(j, "buffers", '[');
	json_begin(j, '{');
	json_key_uint(j, "byteLength", g->n_bytes);
	json_end(j, '}');
	json_end(j, ']');
	json_end(j, '}');
}

/* Write a chunk of a .glb (glTF 2.0 sec. 4.4.3): length, type, bytes, padded to a multiple of 4. */
static int write_chunk(FILE *out, uint32_t type, const void *bytes, size_t n, char filler)
{
	const uint32_t head[2] = { (uint32_t)((n + 3) & ~(size_t)3), type };
	const char fill[4] = { filler, filler, filler, filler };

	return fwrite(head, 8, 1, out) == 1 && fwrite(bytes, 1, n, out) == n &&
	       fwrite(fill, 1, head[0] - n, out) == head[0] - n;
}

int gltf_write(FILE *out, const char *where, const struct scene *scene, struct gltf_losses *losses)
{
	struct gltf g;
	struct json j = { 0 };
	char *text = NULL;
	size_t n_text = 0, total;
	int rc = 0;

	gltf_gather(&g, scene, losses);
	if (!g.failed && !g.n_spaces) {
		rc = err_report(ERR_INPUT, where, "the frame draws nothing that has a colour");
		goto done;
	}
	j.out = g.failed ? NULL : open_memstream(&text, &n_text);
	if (j.out) {
		write_text(&j, &g);
		if (fclose(j.out))
			g.failed = 1;
	}
	if (!j.out || g.failed) {
		rc = err_report(ERR_SYSTEM, where, "out of memory");
		goto done;
	}
	total = 12 + 16 + ((n_text + 3) & ~(size_t)3) + ((g.n_bytes + 3) & ~(size_t)3);
	if (total > UINT32_MAX) {
		rc = err_report(ERR_INPUT, where, "the frame is larger than the 4 GiB that a .glb can hold");
		goto done;
	}
	if (fwrite((const uint32_t[]){ 0x46546c67, 2, (uint32_t)total }, 12, 1, out) != 1 ||
	    !write_chunk(out, 0x4e4f534a, text, n_text, ' ') || !write_chunk(out, 0x004e4942, g.bytes, g.n_bytes, 0))
		rc = err_report(ERR_SYSTEM, where, "cannot be written: %s", strerror(errno));
done:
	free(text);
	gltf_free(&g);
	return rc;
}
