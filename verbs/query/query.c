/* relume query: rays, distances and collisions with a frame's triangles; queries come from a file or a pipe. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/options.h"
#include "base/part.h"
#include "base/verbs.h"
#include "verbs/query/relume-rays.h"

#define BATCH 262144
#define MOST_HITS 1024u
#define LINE_BYTES 1024

enum kind { NEAREST, ANY, ALL, DISTANCE, BOX, SPHERE, N_KINDS };
static const char *const kind_names[N_KINDS + 1] = { "nearest", "any", "all", "distance", "box", "sphere", NULL };
/* Numbers in a query. */
static const unsigned kind_numbers[N_KINDS] = { 8, 8, 8, 4, 9, 7 };

struct asked {
	uint64_t frame;
	enum kind kind;
	unsigned most;
	int binary;
	const char *output, *device;
};

static const struct options_row rows[] = {
	{ "frame", 'f', "N", "which frame, from 0 (default 0)", options_frame, .at = offsetof(struct asked, frame) },
	{ "kind", 'k', "KIND", "the query: nearest, any, all, distance, box or sphere (default nearest)", options_word,
	  .at = offsetof(struct asked, kind), .words = kind_names },
	{ "most", 'm', "N", "with all: print the N nearest hits of a ray (default 16)", options_number,
	  .at = offsetof(struct asked, most), .most = MOST_HITS },
	{ "binary", 'b', NULL, "queries and answers are 4-byte numbers in this machine's byte order, without lines",
	  options_flag, .at = offsetof(struct asked, binary) },
	{ "output", 'o', "FILE",
	  "file for the answers, which appears once it is complete (default: standard output, as they come)",
	  options_text, .at = offsetof(struct asked, output), .use = CONFINE_MAKES },
	{ "device", 'd', "DEVICE",
	  "a number from 'relume devices', cpu, gpu, accelerator, part of a name, or reference", options_text,
	  .at = offsetof(struct asked, device) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "query",
	.head = "usage: relume query [OPTIONS] TRACE [QUERIES]\n"
		"\n"
		"Find what rays hit, how far surfaces are, and what moving bodies meet among the triangles that one "
	        "frame draws.\n"
		"\n"
		"QUERIES  a file, a query a line (default: standard input). Numbers are in eye space: the viewer at 0 "
	        "looks along -z\n",
	OPTIONS_ROWS(rows),
	.notes =
		"Each kind of query, and its answer:\n"
		"  nearest   origin x y z, nearest t, direction x y z, farthest t     t b1 b2 triangle draw primitive\n"
		"  any       the same                                                 0 or 1\n"
		"  all       the same                                                 how many hits, then t b1 b2 "
	        "triangle of each\n"
		"  distance  point x y z, farthest distance                           distance x y z triangle draw "
	        "primitive\n"
		"  box       centre x y z, half its edges x y z, way x y z            share of the way, triangle draw "
	        "primitive\n"
		"  sphere    centre x y z, radius, way x y z                          the same\n"
		"If nothing is found, the line is '-'. Empty lines and text after '#' are ignored. With --binary there "
	        "are no draw\n"
		"and primitive, nothing found is triangle 4294967295, and all gives the number of hits, then always "
	        "--most of them.\n"
		"Exit codes: 0 done, 2 wrong usage, 3 a recording or a query cannot be read, 5 the device or the "
	        "system failed.\n",
	.takes = "a trace, and at most one file of queries",
	.least = 1,
	.most = 2,
	.words_use = CONFINE_RECORDING,
};

/* The source of queries and the destination of answers. */
struct stream {
	const struct asked *asked;
	const char *name;
	FILE *in, *out;
	uint64_t line;
	struct relume_rays *rays;
	float *numbers;         /* [BATCH] queries */
	union {
		struct relume_rays_hit *hits;
		struct relume_rays_distance *distances;
		struct relume_rays_contact *contacts;
		void *any;
	} answers;
	uint32_t *counts;
};

/* --- Queries in -------------------------------------------------------------------------------------------------- */

/* Read a line's numbers. @return 1; 0: it has none; ERR_INPUT (reported) */
static int read_line(struct stream *s, char *line, float *out)
{
	const unsigned wanted = kind_numbers[s->asked->kind];
	char where[LINE_BYTES], *at = line, *end;
	unsigned n = 0;

	line[strcspn(line, "#\n")] = '\0';
	for (;; at = end, n++) {
		const float value = strtof(at, &end);

		if (end == at)
			break;
		if (n < wanted)
			out[n] = value;
	}
	at += strspn(at, " \t\r");
	if (!*at && (n == wanted || n == 0))
		return n != 0;
	snprintf(where, sizeof(where), "%s:%" PRIu64, s->name, s->line);
	return err_report(ERR_INPUT, where, "'%s' queries have %u numbers", kind_names[s->asked->kind], wanted);
}

/* @return the number of queries read; 0: none are left; ERR_INPUT (reported) */
static long read_text(struct stream *s)
{
	char line[LINE_BYTES];
	long n = 0;

	while (n < BATCH && fgets(line, sizeof(line), s->in)) {
		int rc;

		s->line++;
		if (!strchr(line, '\n') && !feof(s->in))
			return err_report(ERR_INPUT, s->name, "line %" PRIu64 " is too long", s->line);
		rc = read_line(s, line, s->numbers + (size_t)n * kind_numbers[s->asked->kind]);
		if (rc < 0)
			return rc;
		n += rc;
	}
	return n;
}

static long read_binary(struct stream *s)
{
	const size_t bytes = kind_numbers[s->asked->kind] * sizeof(float), n = fread(s->numbers, 1, BATCH * bytes, s->in);

	if (n % bytes)
		return err_report(ERR_INPUT, s->name, "ends within a query: '%s' queries have %zu bytes",
		                  kind_names[s->asked->kind], bytes);
	return (long)(n / bytes);
}

static long read_batch(struct stream *s)
{
	const long n = s->asked->binary ? read_binary(s) : read_text(s);

	return n >= 0 && ferror(s->in) ? err_report(ERR_INPUT, s->name, "%s", strerror(errno)) : n;
}

/* --- Answers out ------------------------------------------------------------------------------------------------- */

static void print_triangle(const struct stream *s, uint32_t triangle)
{
	struct relume_rays_triangle t;

	relume_rays_describe(s->rays, triangle, &t);
	fprintf(s->out, " %u %u %u\n", triangle, t.draw, t.primitive);
}

static void print_hits(const struct stream *s, size_t i)
{
	const uint32_t kept = s->counts[i] < s->asked->most ? s->counts[i] : s->asked->most;
	const struct relume_rays_hit *hits = s->answers.hits + i * s->asked->most;

	fprintf(s->out, "%u", s->counts[i]);
	for (uint32_t k = 0; k < kept; k++)
		fprintf(s->out, "  %.9g %.9g %.9g %u", hits[k].t, hits[k].b1, hits[k].b2, hits[k].triangle);
	fputc('\n', s->out);
}

static void print_answer(const struct stream *s, size_t i)
{
	const struct relume_rays_hit *hit = &s->answers.hits[i];
	const struct relume_rays_distance *distance = &s->answers.distances[i];
	const struct relume_rays_contact *contact = &s->answers.contacts[i];
	uint32_t triangle;

	switch (s->asked->kind) {
	case ANY:
		fprintf(s->out, "%u\n", ((const uint32_t *)s->answers.any)[i]);
		return;
	case ALL:
		print_hits(s, i);
		return;
	case NEAREST:
		triangle = hit->triangle;
		if (triangle != RELUME_RAYS_NONE)
			fprintf(s->out, "%.9g %.9g %.9g", hit->t, hit->b1, hit->b2);
		break;
	case DISTANCE:
		triangle = distance->triangle;
		if (triangle != RELUME_RAYS_NONE)
			fprintf(s->out, "%.9g %.9g %.9g %.9g", distance->distance, distance->nearest[0],
			        distance->nearest[1], distance->nearest[2]);
		break;
	default:
		triangle = contact->triangle;
		if (triangle != RELUME_RAYS_NONE)
			fprintf(s->out, "%.9g", contact->t);
	}
	if (triangle == RELUME_RAYS_NONE)
		fputs("-\n", s->out);
	else
		print_triangle(s, triangle);
}

static void write_binary(const struct stream *s, size_t n)
{
	static const size_t bytes[N_KINDS] = { sizeof(struct relume_rays_hit),     sizeof(uint32_t),
		                               sizeof(struct relume_rays_hit),     sizeof(struct relume_rays_distance),
		                               sizeof(struct relume_rays_contact), sizeof(struct relume_rays_contact) };

	if (s->asked->kind != ALL) {
		fwrite(s->answers.any, bytes[s->asked->kind], n, s->out);
		return;
	}
	for (size_t i = 0; i < n; i++) {
		fwrite(&s->counts[i], sizeof(*s->counts), 1, s->out);
		fwrite(s->answers.hits + i * s->asked->most, sizeof(*s->answers.hits), s->asked->most, s->out);
	}
}

/* A sphere's query holds its radius once. */
static void spread_spheres(const float *numbers, size_t n, struct relume_rays_body *out)
{
	for (size_t i = 0; i < n; i++) {
		const float *q = numbers + 7 * i;

		out[i] = (struct relume_rays_body){ { q[0], q[1], q[2] }, { q[3], q[3], q[3] }, { q[4], q[5], q[6] } };
	}
}

static int ask(struct stream *s, size_t n, struct relume_rays_body *bodies)
{
	const void *q = s->numbers;

	switch (s->asked->kind) {
	case ANY:
		return relume_rays_any(s->rays, q, n, s->answers.any);
	case ALL:
		return relume_rays_all(s->rays, q, n, s->asked->most, s->answers.hits, s->counts);
	case DISTANCE:
		return relume_rays_distance(s->rays, q, n, s->answers.distances);
	case BOX:
		return relume_rays_move_box(s->rays, q, n, s->answers.contacts);
	case SPHERE:
		spread_spheres(q, n, bodies);
		return relume_rays_move_sphere(s->rays, bodies, n, s->answers.contacts);
	default:
		return relume_rays_nearest(s->rays, q, n, s->answers.hits);
	}
}

/* --- The verb ---------------------------------------------------------------------------------------------------- */

/* All queries, batch by batch. @return 0 or ERR_* (reported) */
static int answer_all(struct stream *s)
{
	const size_t per = s->asked->kind == ALL ? s->asked->most : 1;
	struct relume_rays_body *bodies = malloc(BATCH * sizeof(*bodies));
	int err = 0;
	long n = 0;

	/* NOLINTNEXTLINE(clang-analyzer-unix.MallocSizeof): for the longest kind of query, in floats */
	s->numbers = malloc(BATCH * sizeof(struct relume_rays_body));
	s->answers.any = malloc(BATCH * per * sizeof(struct relume_rays_distance));
	s->counts = malloc(BATCH * sizeof(*s->counts));
	if (!bodies || !s->numbers || !s->answers.any || !s->counts)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	while (!err && (n = read_batch(s)) > 0) {
		err = -ask(s, (size_t)n, bodies);
		if (!err && s->asked->binary)
			write_binary(s, (size_t)n);
		for (long i = 0; i < n && !err && !s->asked->binary; i++)
			print_answer(s, (size_t)i);
		if (!err && fflush(s->out) != 0)
			err = err_report(ERR_SYSTEM, s->asked->output, "%s", strerror(errno));
	}
	free(bodies);
	free(s->numbers);
	free(s->answers.any);
	free(s->counts);
	return err ? err : (int)n;
}

static int query(const struct asked *o, const char *trace, const char *queries)
{
	struct stream s = { .asked = o, .name = queries ? queries : "standard input", .in = stdin, .out = stdout };
	struct part_file file;
	int err = 0;

	if (queries && !(s.in = fopen(queries, "r")))
		return err_report(ERR_INPUT, queries, "%s", strerror(errno));
	err = -relume_rays_open_frame(trace, o->frame, o->device, &s.rays);
	if (!err && o->output) {
		err = folder_make_for(o->output);
		if (!err && !(err = part_open(&file, o->output))) {
			s.out = file.stream;
			err = part_close(&file, answer_all(&s));
		}
	} else if (!err) {
		err = answer_all(&s);
	}
	relume_rays_close(&s.rays);
	if (queries)
		fclose(s.in);
	return err;
}

int query_main(int argc, char **argv)
{
	struct asked o = { .most = 16 };
	struct options_line line;
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc && !o.most)
		rc = err_report(ERR_USAGE, "--most", "at least 1");
	if (!rc)
		rc = options_confine(&table, &line, CONFINE_TRACER, NULL);
	if (!rc)
		rc = query(&o, line.words[0], line.n_words > 1 ? line.words[1] : NULL);
	return rc > 0 ? 0 : -rc;
}
