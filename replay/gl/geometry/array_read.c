#include "replay/gl/geometry/array_read.h"

#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "base/half.h"
#include "base/norm.h"
#include "capture/format/sizes.h"
#include "replay/gl/geometry/packed.h"
#include "replay/machine/buffer.h"
#include "replay/machine/errors.h"

size_t gls_type_bytes(uint32_t type)
{
	return type <= GL_FLOAT || type == GL_HALF_FLOAT || type == GL_FIXED || type == GL_DOUBLE ?
	               (size_t)type_bytes(type) :
	               0;
}

static unsigned components(const struct gls_array *array)
{
	return array->size == GL_BGRA ? 4 : array->size < 1 || array->size > 4 ? 0 : (unsigned)array->size;
}

static int gls_source_open(struct gls_exec *x, struct gls_state *st, const struct gls_array *array,
                           struct gls_source *s)
{
	struct gls_buffer *b = gls_buffer_find(st, array->buffer);

	*s = (struct gls_source){ .array = array };
	s->element = gls_is_packed(array->type) ? sizeof(uint32_t) : components(array) * gls_type_bytes(array->type);
	s->stride = array->stride ? (size_t)array->stride : s->element;
	if (!array->buffer) {
		s->bytes = array->client;
		s->n = array->client_bytes;
		s->version = array->version;
	} else if (b && b->data && array->offset <= b->bytes) {
		s->bytes = b->data + array->offset;
		s->n = b->bytes - array->offset;
		s->version = b->version;
		gls_buffer_draws(x, st, b);
	}
	return s->element && s->bytes && s->n >= s->element;
}

/* The same four floats for every vertex; they are not copied. */
static struct gls_source constant_source(const float value[4])
{
	static const struct gls_array array = { .enabled = 1, .size = 4, .type = GL_FLOAT };

	return (struct gls_source){ .bytes = (const uint8_t *)value, .n = 4 * sizeof(float), .element = 4 * sizeof(float),
	                            .version = XXH3_64bits(value, 4 * sizeof(float)), .array = &array };
}

static uint64_t source_count(const struct gls_source *s)
{
	return s->stride ? (s->n - s->element) / s->stride + 1 : UINT32_MAX;
}

/* The most elements that an attribute's array has. */
static uint64_t longest_attribute(const struct gls_sources *s)
{
	uint64_t most = 0;

	for (uint32_t present = s->present; present; present &= present - 1) {
		const uint64_t n = source_count(&s->attributes[__builtin_ctz(present)]);

		most = n > most ? n : most;
	}
	return most;
}

uint64_t gls_sources_count(const struct gls_sources *s)
{
	return s->vertex.stride ? source_count(&s->vertex) : longest_attribute(s);
}

uint64_t gls_sources_end(const struct gls_sources *s)
{
	const uint64_t count = gls_sources_count(s), longest = longest_attribute(s);

	return count > longest ? count : longest;
}

/*
 * An integer of an array as a number in [-1,1], as Mesa (22.3.6) fetches it: by multiplication, while single calls
 * divide. The two lowest values of a signed type both become -1 (OpenGL 4.2 sec. 2.3.4), while single calls follow
 * OpenGL 2.1 table 2.9.
 */
static float normal(float value, float most)
{
	const float v = value * (1 / most);

	return v < -1 ? -1 : v;
}

static float read_component(const uint8_t *p, uint32_t type, uint32_t normalized)
{
	int8_t i8;
	int16_t i16;
	uint16_t u16;
	int32_t i32;
	uint32_t u32;
	float f;
	double d;

	switch (type) {
	case GL_BYTE:
		memcpy(&i8, p, 1);
		return normalized ? normal(i8, 127) : i8;
	case GL_UNSIGNED_BYTE:
		return normalized ? normal(*p, 255) : *p;
	case GL_SHORT:
		memcpy(&i16, p, 2);
		return normalized ? normal(i16, 32767) : i16;
	case GL_UNSIGNED_SHORT:
		memcpy(&u16, p, 2);
		return normalized ? normal(u16, 65535) : u16;
	case GL_INT:
		memcpy(&i32, p, 4);
		return normalized ? normal((float)i32, (float)INT32_MAX) : (float)i32;
	case GL_UNSIGNED_INT:
		memcpy(&u32, p, 4);
		return normalized ? (float)(u32 / 4294967295.0) : (float)u32;
	case GL_FIXED:
		memcpy(&i32, p, 4);
		return (float)i32 / 65536.0f;
	case GL_HALF_FLOAT:
		memcpy(&u16, p, 2);
		return half_to_float(u16);
	case GL_DOUBLE:
		memcpy(&d, p, 8);
		return (float)d;
	default:
		memcpy(&f, p, 4);
		return f;
	}
}

void gls_source_read(const struct gls_source *s, uint64_t i, float out[4])
{
	const struct gls_array *array = s->array;
	unsigned n = components(array);
	size_t size = gls_type_bytes(array->type);
	const uint8_t *p;
	uint32_t packed;

	out[0] = out[1] = out[2] = 0;
	out[3] = i < source_count(s) || n < 4;
	if (i >= source_count(s))
		return;
	p = s->bytes + i * s->stride;
	if (array->type == GL_FLOAT) {
		memcpy(out, p, n * sizeof(float));
		return;
	}
	if (gls_is_packed(array->type)) {
		memcpy(&packed, p, sizeof(packed));
		gls_unpack_packed(packed, array->type, 0, out);
		for (unsigned k = 0; k < n && array->normalized; k++)
			out[k] = normal(out[k], (float)((1 << ((k < 3 ? 10 : 2) - (array->type == GL_INT_2_10_10_10_REV))) - 1));
		for (unsigned k = n; k < 4; k++)
			out[k] = k == 3;
	}
	for (unsigned k = 0; k < n && !gls_is_packed(array->type); k++)
		out[k] = read_component(p + k * size, array->type, array->normalized);
	if (array->size == GL_BGRA) {
		float blue = out[0];
		out[0] = out[2];
		out[2] = blue;
	}
}

uint32_t gls_sources_open_attributes(struct gls_exec *x, struct gls_state *st, struct gls_sources *s)
{
	const struct gls_array *arrays = st->client.arrays;
	const unsigned n = st->a.programs.vertex || st->program || st->list ? N_GLS_ATTRIBUTES : GLS_ATTR_GENERIC;

	memset(s, 0, sizeof(*s));
	for (unsigned a = 0; a < n; a++)
		if (arrays[a].enabled && gls_source_open(x, st, &arrays[a], &s->attributes[a]))
			s->present |= 1u << a;
	return s->present;
}

int gls_sources_open(struct gls_exec *x, struct gls_state *st, struct gls_sources *s)
{
	const struct gls_array *arrays = st->client.arrays;
	const struct gls_array *vertex = &arrays[arrays[GLS_ARRAY_GENERIC0].enabled ? GLS_ARRAY_GENERIC0 : GLS_ARRAY_VERTEX];

	gls_sources_open_attributes(x, st, s);
	if (!vertex->enabled) {
		if (!st->program && !st->a.programs.vertex)
			return 0; /* nothing is drawn without it (sec. 2.8) */
		if (!s->present) {
			gls_unsupported(x, "draws without arrays");
			return 0;
		}
		s->vertex = constant_source(st->a.current.generic0); /* a program gets positions from elsewhere */
	} else if (!gls_source_open(x, st, vertex, &s->vertex)) {
		gls_unsupported(x, "arrays whose contents are not in the recording");
		return 0;
	}
	s->has_sizes = arrays[GLS_ARRAY_POINT_SIZE].enabled && gls_source_open(x, st, &arrays[GLS_ARRAY_POINT_SIZE], &s->size);
	s->has_edges = arrays[GLS_ARRAY_EDGE_FLAG].enabled && gls_source_open(x, st, &arrays[GLS_ARRAY_EDGE_FLAG], &s->edge);
	return 1;
}

uint64_t gls_sources_key(const struct gls_state *st, const struct gls_sources *s, uint32_t mode, uint64_t elements,
                         uint64_t n_elements)
{
	uint64_t key[8 * (N_GLS_ATTRIBUTES + 2) + 4];
	const struct gls_source *all[N_GLS_ATTRIBUTES + 2];
	unsigned n = 0, n_sources = 0;

	key[n++] = (uint64_t)mode << 32 | (uint64_t)st->a.lighting.first_provokes << 31 | s->present;
	key[n++] = elements;
	key[n++] = n_elements;
	key[n++] = s->has_edges ? 2 : st->a.current.edge_flag != 0;
	all[n_sources++] = &s->vertex;
	if (s->has_edges)
		all[n_sources++] = &s->edge;
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		if (s->present >> a & 1)
			all[n_sources++] = &s->attributes[a];
	for (unsigned i = 0; i < n_sources; i++) {
		key[n++] = all[i]->version;
		key[n++] = all[i]->n;
		key[n++] = all[i]->stride;
		key[n++] = (uint64_t)all[i]->array->type << 32 | (uint32_t)all[i]->array->size;
		key[n++] = (uint64_t)all[i]->array->buffer << 32 | all[i]->array->normalized;
		key[n++] = all[i]->array->offset;
	}
	return XXH3_64bits(key, n * sizeof(key[0]));
}
