#include "replay/gl/texture/s3tc.h"

#include <stdlib.h>
#include <string.h>

/* With one bit of alpha, colours above this alpha are opaque. */
#define CUT_ALPHA 127

static const int weights[3] = { 4, 16, 1 }; /* for R, G and B in colour distances */

struct color {
	int v[3];
};

static int limited(int v)
{
	return v < 0 ? 0 : v > 255 ? 255 : v;
}

static struct color color_of(const uint8_t *texel)
{
	return (struct color){ { texel[0], texel[1], texel[2] } };
}

static unsigned apart(const uint8_t *texel, const struct color *c)
{
	unsigned sum = 0;

	for (unsigned i = 0; i < 3; i++)
		sum += (unsigned)(weights[i] * (texel[i] - c->v[i]) * (texel[i] - c->v[i]));
	return sum;
}

static unsigned word_565(const struct color *c)
{
	return (unsigned)((c->v[0] & 0xf8) << 8 | (c->v[1] & 0xfc) << 3 | c->v[2] >> 3);
}

static void swap(struct color ends[2])
{
	const struct color first = ends[0];

	ends[0] = ends[1];
	ends[1] = first;
}

/* The mean of two colours, with the first weighted by `share`. */
static struct color mixed(const struct color *a, int share, const struct color *b)
{
	struct color c;

	for (unsigned i = 0; i < 3; i++)
		c.v[i] = (a->v[i] * share + b->v[i]) / (share + 1);
	return c;
}

static void four_colors(const struct color ends[2], struct color out[4])
{
	out[0] = ends[0];
	out[1] = ends[1];
	out[2] = mixed(&ends[0], 2, &ends[1]);
	out[3] = mixed(&ends[1], 2, &ends[0]);
}

/* The nearest of n colours, the first one among equals. @return its distance */
static unsigned nearest(const uint8_t *texel, const struct color *colors, unsigned n, unsigned *code)
{
	unsigned least = ~0u;

	for (unsigned i = 0; i < n; i++) {
		const unsigned far = apart(texel, &colors[i]);

		if (far < least) {
			least = far;
			*code = i;
		}
	}
	return least;
}

static int is_clear(enum s3tc_kind kind, const uint8_t *texel)
{
	return kind == S3TC_RGBA && texel[3] <= CUT_ALPHA;
}

/*
 * The darkest and the brightest texel. @return 1 if some texels are transparent: these are ignored, except for the
 * first
 */
static int find_ends(enum s3tc_kind kind, const struct s3tc_texels *t, struct color ends[2])
{
	const struct color black = { { 0 } };
	unsigned low = apart(t->rgba[0][0], &black), high = low;
	int clear = 0;

	ends[0] = ends[1] = color_of(t->rgba[0][0]);
	for (unsigned i = 0; i < t->width * t->height; i++) {
		const uint8_t *texel = t->rgba[i / t->width][i % t->width];
		const unsigned far = apart(texel, &black);

		if (is_clear(kind, texel)) {
			clear = 1;
		} else if (far > high) {
			high = far;
			ends[1] = color_of(texel);
		} else if (far < low) {
			low = far;
			ends[0] = color_of(texel);
		}
	}
	return clear;
}

/* Move both ends by the errors of the texels, each in proportion to its weight. */
static void move_ends(const struct s3tc_texels *t, struct color ends[2])
{
	static const int shares[4][2] = { { 3, 0 }, { 0, 3 }, { 2, 1 }, { 1, 2 } };
	struct color colors[4];
	int off[2][3] = { { 0 } }, n[2] = { 0 };

	four_colors(ends, colors);
	for (unsigned i = 0; i < t->width * t->height; i++) {
		const uint8_t *texel = t->rgba[i / t->width][i % t->width];
		unsigned code = 0;

		nearest(texel, colors, 4, &code);
		for (unsigned end = 0; end < 2; end++) {
			n[end] += shares[code][end];
			for (unsigned k = 0; k < 3; k++)
				off[end][k] += shares[code][end] * (texel[k] - colors[code].v[k]);
		}
	}
	for (unsigned end = 0; end < 2; end++)
		for (unsigned k = 0; k < 3; k++)
			ends[end].v[k] = limited(ends[end].v[k] + off[end][k] / (n[end] ? n[end] : 1));
}

/* Separate ends that may be equal in 5, 6 and 5 bits. The comparison of red with green is Mesa's. */
static void part_ends(struct color ends[2])
{
	const int red = abs(ends[0].v[0] - ends[1].v[0]), green = abs(ends[0].v[1] - ends[1].v[1]),
		  blue = abs(ends[0].v[2] - ends[1].v[2]);
	const int most = red > 2 * green ? red > blue ? red : blue : 2 * green > blue ? 2 * green : blue;
	const int factor = most > 4 ? 2 : most > 2 ? 3 : 4, up = ends[1].v[1] >= ends[0].v[1];
	struct color *a = &ends[up], *b = &ends[!up];
	int *moved;

	if (red >= 8 || green >= 4 || blue >= 8 || most == 0)
		return;
	a->v[1] = limited(a->v[1] + factor * 2 * green);
	moved = a->v[0] > b->v[1] ? a->v : b->v;
	moved[0] = limited(moved[0] + factor * red);
	moved = a->v[2] > b->v[2] ? a->v : b->v;
	moved[2] = limited(moved[2] + factor * blue);
}

/* Choose two bits per texel, with four colours. @return total error */
static unsigned code_four(const struct s3tc_texels *t, const struct color ends[2], uint32_t *codes)
{
	struct color colors[4];
	unsigned sum = 0, code = 0;

	four_colors(ends, colors);
	for (unsigned y = 0; y < t->height; y++)
		for (unsigned x = 0; x < t->width; x++) {
			sum += nearest(t->rgba[y][x], colors, 4, &code);
			*codes |= (uint32_t)code << 2 * (4 * y + x);
		}
	return sum;
}

/* As code_four, with three colours, the ends swapped, and a fourth code for transparent texels. */
static unsigned code_three(enum s3tc_kind kind, const struct s3tc_texels *t, const struct color ends[2],
                           uint32_t *codes)
{
	const struct color colors[3] = { ends[1], ends[0], mixed(&ends[0], 1, &ends[1]) };
	const struct color tried[3] = { ends[0], ends[1], colors[2] };
	unsigned sum = 0, code = 0;

	for (unsigned y = 0; y < t->height; y++)
		for (unsigned x = 0; x < t->width; x++) {
			if (is_clear(kind, t->rgba[y][x])) {
				*codes |= 3u << 2 * (4 * y + x);
				continue;
			}
			sum += nearest(t->rgba[y][x], tried, 3, &code);
			*codes |= (uint32_t)(code < 2 ? code ^ 1 : code) << 2 * (4 * y + x);
		}
	return sum;
}

static void put_colors(unsigned first, unsigned second, uint32_t codes, uint8_t *block)
{
	block[0] = (uint8_t)first;
	block[1] = (uint8_t)(first >> 8);
	block[2] = (uint8_t)second;
	block[3] = (uint8_t)(second >> 8);
	for (unsigned i = 0; i < 4; i++)
		block[4 + i] = (uint8_t)(codes >> 8 * i);
}

static void encode_colors(enum s3tc_kind kind, const struct s3tc_texels *t, uint8_t *block)
{
	struct color ends[2];
	const int clear = find_ends(kind, t, ends);
	uint32_t four = 0, three = 0;
	unsigned off_four, off_three = ~0u;

	if (word_565(&ends[0]) >= word_565(&ends[1]))
		swap(ends);
	move_ends(t, ends);
	part_ends(ends);
	for (unsigned i = 0; i < 6; i++)
		ends[i / 3].v[i % 3] &= i % 3 == 1 ? 0xfc : 0xf8;
	if (word_565(&ends[0]) < word_565(&ends[1]))
		swap(ends);
	off_four = code_four(t, ends, &four);
	if (kind == S3TC_RGB || kind == S3TC_RGBA)
		off_three = code_three(kind, t, ends, &three);
	if (off_four > off_three || clear)
		put_colors(word_565(&ends[1]), word_565(&ends[0]), three, block);
	else
		put_colors(word_565(&ends[0]), word_565(&ends[1]), four, block);
}

/* ---- alpha in levels ---- */

/* An encoding of the texels' alpha: two numbers, and three bits per texel. */
struct levels {
	int first, second;
	uint8_t codes[16];
	unsigned off; /* sum of squared errors */
};

/* The code of a level: the ends come first. */
static uint8_t level_code(int level, int steps)
{
	return (uint8_t)(level == 0 ? 0 : level == steps ? 1 : level + 1);
}

static int level_value(int from, int to, int level, int steps)
{
	return (from * (steps - level) + to * level) / steps;
}

/* The value that the next level begins with. */
static int level_end(int from, int to, int level, int steps)
{
	return (from * (2 * steps - (2 * level + 1)) + to * (2 * level + 1)) / (2 * steps);
}

static void take(struct levels *l, unsigned at, int code, int lost)
{
	l->codes[at] = (uint8_t)code;
	l->off += (unsigned)(lost * lost);
}

static int alpha_at(const struct s3tc_texels *t, unsigned i)
{
	return t->rgba[i / 4][i % 4][3];
}

static int is_inside(const struct s3tc_texels *t, unsigned i)
{
	return i % 4 < t->width && i / 4 < t->height;
}

/* Eight levels, from the highest alpha to the lowest. */
static void code_eight(const struct s3tc_texels *t, int low, int high, struct levels *out)
{
	*out = (struct levels){ high, low, { 0 }, 0 };
	for (unsigned i = 0; i < 16; i++) {
		const int a = alpha_at(t, i);
		int level = 0;

		if (!is_inside(t, i))
			continue;
		while (level < 7 && a <= level_end(high, low, level, 7))
			level++;
		take(out, i, level_code(level, 7), a - level_value(high, low, level, 7));
	}
}

static int level_of_six(int a, int low, int high)
{
	int level = 0;

	while (level < 5 && a > level_end(low, high, level, 5))
		level++;
	return level;
}

/* Six levels, and codes for 0 and 255. none, all: limits below and above which these codes are used */
static void code_six(const struct s3tc_texels *t, int low, int high, int none, int all, struct levels *out)
{
	*out = (struct levels){ low, high, { 0 }, 0 };
	for (unsigned i = 0; i < 16; i++) {
		const int a = alpha_at(t, i), level = level_of_six(a, low, high);

		if (!is_inside(t, i))
			continue;
		if (a <= none)
			take(out, i, 6, a);
		else if (a > all)
			take(out, i, 7, 255 - a);
		else
			take(out, i, level_code(level, 5), a - level_value(low, high, level, 5));
	}
}

/* Try other ends for six levels: moved by the texels' errors, without those close to 0 and 255. */
static void move_levels(const struct s3tc_texels *t, int *low, int *high)
{
	const int close = (*high - *low) / 28;
	int from = 255, to = 0, off[2] = { 0 }, n[2] = { 0 };

	for (unsigned i = 0; i < 16; i++) {
		const int a = alpha_at(t, i);

		if (is_inside(t, i) && a > to && a < 255 - close)
			to = a;
		if (is_inside(t, i) && a < from && a > close)
			from = a;
	}
	if (to <= from) {
		from = 1;
		to = 254;
	}
	for (unsigned i = 0; i < 16; i++) {
		const int a = alpha_at(t, i), level = level_of_six(a, from, to), lost = a - level_value(from, to, level, 5);

		if (!is_inside(t, i) || a <= from / 2 || a > (255 + to) / 2)
			continue;
		off[0] += level < 5 ? lost : 0;
		n[0] += level < 5;
		off[1] += level > 0 ? lost : 0;
		n[1] += level > 0;
	}
	*low = limited(from + off[0] / (n[0] ? n[0] : 1));
	*high = limited(to + off[1] / (n[1] ? n[1] : 1));
}

static void put_levels(const struct levels *l, uint8_t *block)
{
	uint64_t bits = 0;

	for (unsigned i = 0; i < 16; i++)
		bits |= (uint64_t)l->codes[i] << 3 * i;
	block[0] = (uint8_t)l->first;
	block[1] = (uint8_t)l->second;
	for (unsigned i = 0; i < 6; i++)
		block[2 + i] = (uint8_t)(bits >> 8 * i);
}

static void encode_levels(const struct s3tc_texels *t, uint8_t *block)
{
	int low = 255, high = 0, none = 0, all = 0; /* low, high: range of the values other than 0 and 255 */
	struct levels best, other;

	for (unsigned i = 0; i < 16; i++) {
		const int a = alpha_at(t, i);

		if (!is_inside(t, i))
			continue;
		none |= a == 0;
		all |= a == 255;
		if (a != 0 && a != 255) {
			low = a < low ? a : low;
			high = a > high ? a : high;
		}
	}
	if (low > high && !(none && all)) {
		put_levels(&(struct levels){ alpha_at(t, 0), 0, { 0 }, 0 }, block);
		return;
	}
	code_eight(t, none ? 0 : low, all ? 255 : high, &best);
	if (best.off >= 32) {
		const unsigned eight = best.off;

		code_six(t, low, high, 0, 254, &other);
		if (other.off < best.off)
			best = other;
		if (other.off > 96 && eight > 96) {
			move_levels(t, &low, &high);
			code_six(t, low, high, low / 2, (255 + high) / 2, &other);
			if (other.off < best.off)
				best = other;
		}
	}
	put_levels(&best, block);
}

void s3tc_encode(enum s3tc_kind kind, const struct s3tc_texels *t, uint8_t *block)
{
	memset(block, 0, 8);
	if (kind == S3TC_LEVELS)
		encode_levels(t, block);
	for (unsigned i = 0; i < 16 && kind == S3TC_BITS; i++)
		if (is_inside(t, i))
			block[i / 2] |= (uint8_t)(alpha_at(t, i) >> 4 << 4 * (i & 1));
	encode_colors(kind, t, block + (kind == S3TC_LEVELS || kind == S3TC_BITS ? 8 : 0));
}
