/* Growing arrays of a glTF file's contents. */
#include "scene/gltf_pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int gltf_grow(struct gltf *g, void **items, uint32_t n, size_t size)
{
	void *grown;

	if (g->failed || (n & (n - 1)) || n == 1u << 31)
		return g->failed; /* room is the next power of two */
	grown = realloc(*items, (n ? 2 * (size_t)n : 1) * size);
	if (!grown)
		return g->failed = 1;
	*items = grown;
	return 0;
}

void *gltf_put_piece(struct gltf *g, size_t n, uint32_t target, uint32_t *number)
{
	size_t at = (g->n_bytes + 3) & ~(size_t)3;

	if (at + n > g->room) {
		size_t room = at + n + g->room;
		uint8_t *grown = realloc(g->bytes, room);
		if (!grown) {
			g->failed = 1;
			return NULL;
		}
		g->bytes = grown;
		g->room = room;
	}
	memset(g->bytes + g->n_bytes, 0, at - g->n_bytes);
	g->n_bytes = at + n;
	*number = GLTF_PUSH(g, pieces, ((struct gltf_piece){ at, n, target }));
	return g->failed ? NULL : g->bytes + at;
}

void gltf_shrink_piece(struct gltf *g, uint32_t piece, size_t n)
{
	g->pieces[piece].n_bytes = n;
	g->n_bytes = g->pieces[piece].offset + n;
}

void gltf_free(struct gltf *g)
{
	free(g->bytes);
	free(g->pieces);
	free(g->accessors);
	free(g->looks);
	free(g->sampled);
	free(g->parts);
	free(g->nodes);
	free(g->spaces);
}

float gltf_linear(float v)
{
	v = v < 0 ? 0 : v > 1 ? 1 : v;
	return v <= 0.04045f ? v / 12.92f : powf((v + 0.055f) / 1.055f, 2.4f);
}

void gltf_normalise(float v[3])
{
	float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

	if (length > 0 && isfinite(length)) {
		for (int i = 0; i < 3; i++)
			v[i] /= length;
	} else {
		v[0] = v[1] = 0;
		v[2] = 1;
	}
}
