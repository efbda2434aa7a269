/* Reads relume-diff.yaml, and applies its rules to a frame. */
#include "diff/rules/rules.h"

#include <fnmatch.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/config.h"
#include "base/err.h"
#include "base/frames.h"
#include "base/plural.h"
#include "diff/score/gates.h"
#include "tracer/image/foreign.h"

/* Contents of the file. */

struct yaml_bar {
	enum score_gate_id gate;
	uint32_t figure; /* counted from 1 */
	double *fail, *warn, *better;
};

struct yaml_effect {
	enum score_effect effect;
	double *low, *high; /* per cent */
};

struct yaml_rectangle {
	uint32_t x, y, width, height;
};

struct yaml_rule {
	char *name, *inherits; /* only in presets */
	char *match, *frames, *preset;
	double codes;
	char *channel, *mask;
	bool ignore_alpha;
	struct yaml_bar *bars;
	struct yaml_effect *effects;
	struct yaml_rectangle *ignore;
	char **channels;
	uint32_t n_bars, n_effects, n_ignore, n_channels;
};

struct yaml_flaky {
	char *match, *frames, *reason, *expires;
	enum score_gate_id *gates;
	uint32_t n_gates;
};

struct yaml_file {
	char *baseline;
	struct yaml_rule *presets, *rules;
	struct yaml_flaky *flaky;
	uint32_t n_presets, n_rules, n_flaky;
};

#define GATE_WORD(id, name, ...) { name, GATE_##id },
static const cyaml_strval_t gate_names[] = { SCORE_GATES(GATE_WORD) };
#define EFFECT_WORD(id, name) { name, EFFECT_##id },
static const cyaml_strval_t effect_names[] = { SCORE_EFFECTS(EFFECT_WORD) };

#define OPTIONAL_STRING(key, type, member) \
	CYAML_FIELD_STRING_PTR(key, CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, type, member, 1, CYAML_UNLIMITED)
#define OPTIONAL_NUMBER(key, type, member) \
	CYAML_FIELD_FLOAT_PTR(key, CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, type, member)
#define OPTIONAL_LIST(key, type, member, schema) \
	CYAML_FIELD_SEQUENCE_COUNT(key, CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, type, member, n_##member, schema, 0, \
	                           CYAML_UNLIMITED)

static const cyaml_schema_field_t bar_fields[] = {
	CYAML_FIELD_ENUM("gate", CYAML_FLAG_STRICT, struct yaml_bar, gate, gate_names, CYAML_ARRAY_LEN(gate_names)),
	CYAML_FIELD_UINT("figure", CYAML_FLAG_OPTIONAL, struct yaml_bar, figure),
	OPTIONAL_NUMBER("fail", struct yaml_bar, fail),
	OPTIONAL_NUMBER("warn", struct yaml_bar, warn),
	OPTIONAL_NUMBER("better", struct yaml_bar, better),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t bar_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct yaml_bar, bar_fields) };

static const cyaml_schema_field_t effect_fields[] = {
	CYAML_FIELD_ENUM("effect", CYAML_FLAG_STRICT, struct yaml_effect, effect, effect_names,
	                 CYAML_ARRAY_LEN(effect_names)),
	OPTIONAL_NUMBER("low", struct yaml_effect, low),
	OPTIONAL_NUMBER("high", struct yaml_effect, high),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t effect_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct yaml_effect, effect_fields)
};

static const cyaml_schema_field_t rectangle_fields[] = {
	CYAML_FIELD_UINT("x", CYAML_FLAG_DEFAULT, struct yaml_rectangle, x),
	CYAML_FIELD_UINT("y", CYAML_FLAG_DEFAULT, struct yaml_rectangle, y),
	CYAML_FIELD_UINT("width", CYAML_FLAG_DEFAULT, struct yaml_rectangle, width),
	CYAML_FIELD_UINT("height", CYAML_FLAG_DEFAULT, struct yaml_rectangle, height),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t rectangle_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct yaml_rectangle, rectangle_fields)
};

static const cyaml_schema_value_t string_schema = { CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char, 1, CYAML_UNLIMITED) };
static const cyaml_schema_value_t gate_schema = {
	CYAML_VALUE_ENUM(CYAML_FLAG_STRICT, enum score_gate_id, gate_names, CYAML_ARRAY_LEN(gate_names))
};

/* Keys shared by presets and rules. */
#define RULE_FIELDS \
	CYAML_FIELD_FLOAT("codes", CYAML_FLAG_OPTIONAL, struct yaml_rule, codes), \
	OPTIONAL_STRING("channel", struct yaml_rule, channel), \
	OPTIONAL_STRING("mask", struct yaml_rule, mask), \
	CYAML_FIELD_BOOL("ignore_alpha", CYAML_FLAG_OPTIONAL, struct yaml_rule, ignore_alpha), \
	OPTIONAL_LIST("bars", struct yaml_rule, bars, &bar_schema), \
	OPTIONAL_LIST("effects", struct yaml_rule, effects, &effect_schema), \
	OPTIONAL_LIST("ignore", struct yaml_rule, ignore, &rectangle_schema), \
	OPTIONAL_LIST("channels", struct yaml_rule, channels, &string_schema)

static const cyaml_schema_field_t preset_fields[] = {
	CYAML_FIELD_STRING_PTR("name", CYAML_FLAG_POINTER, struct yaml_rule, name, 1, CYAML_UNLIMITED),
	OPTIONAL_STRING("inherits", struct yaml_rule, inherits),
	RULE_FIELDS,
	CYAML_FIELD_END
};
static const cyaml_schema_value_t preset_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct yaml_rule, preset_fields)
};
static const cyaml_schema_field_t rule_fields[] = {
	OPTIONAL_STRING("match", struct yaml_rule, match),
	OPTIONAL_STRING("frames", struct yaml_rule, frames),
	OPTIONAL_STRING("preset", struct yaml_rule, preset),
	RULE_FIELDS,
	CYAML_FIELD_END
};
static const cyaml_schema_value_t rule_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct yaml_rule,
	                                                              rule_fields) };

static const cyaml_schema_field_t flaky_fields[] = {
	OPTIONAL_STRING("match", struct yaml_flaky, match),
	OPTIONAL_STRING("frames", struct yaml_flaky, frames),
	OPTIONAL_LIST("gates", struct yaml_flaky, gates, &gate_schema),
	CYAML_FIELD_STRING_PTR("reason", CYAML_FLAG_POINTER, struct yaml_flaky, reason, 1, CYAML_UNLIMITED),
	CYAML_FIELD_STRING_PTR("expires", CYAML_FLAG_POINTER, struct yaml_flaky, expires, 1, CYAML_UNLIMITED),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t flaky_schema = {
	CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct yaml_flaky, flaky_fields)
};

static const cyaml_schema_field_t file_fields[] = {
	OPTIONAL_STRING("baseline", struct yaml_file, baseline),
	OPTIONAL_LIST("presets", struct yaml_file, presets, &preset_schema),
	OPTIONAL_LIST("rules", struct yaml_file, rules, &rule_schema),
	OPTIONAL_LIST("flaky", struct yaml_file, flaky, &flaky_schema),
	CYAML_FIELD_END
};
static const cyaml_schema_value_t file_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct yaml_file,
	                                                              file_fields) };

/* The file with everything resolved. */
struct score_rules {
	char *path;
	struct yaml_file *file;
	struct frame_list *rule_frames, *flaky_frames; /* [n_rules], [n_flaky] */
	struct image *preset_masks, *rule_masks;       /* [n_presets], [n_rules]; empty where there is none */
	int *is_expired;                               /* [n_flaky] */
	char *baseline;
};

/** A path from the file, relative to the file's folder; caller frees. */
static char *resolve_path(const char *file, const char *path)
{
	const char *slash = strrchr(file, '/');
	char *out;

	if (path[0] == '/' || !slash)
		return strdup(path);
	return asprintf(&out, "%.*s%s", (int)(slash - file) + 1, file, path) < 0 ? NULL : out;
}

static const struct yaml_rule *find_preset(const struct yaml_file *file, const char *name)
{
	for (uint32_t i = 0; i < file->n_presets; i++)
		if (strcmp(file->presets[i].name, name) == 0)
			return &file->presets[i];
	return NULL;
}

static int check_rule(const struct score_rules *s, const struct yaml_rule *rule, struct image *mask)
{
	for (uint32_t i = 0; i < rule->n_bars; i++) {
		const struct yaml_bar *b = &rule->bars[i];

		if (b->figure > (uint32_t)score_gates[b->gate].n_figures)
			return err_report(ERR_INPUT, s->path, "gate %s has %d figure%s, not %u", score_gates[b->gate].name,
			                  score_gates[b->gate].n_figures, plural(score_gates[b->gate].n_figures), b->figure);
		if (!b->fail && !b->warn && !b->better)
			return err_report(ERR_INPUT, s->path, "a bar of gate %s needs fail, warn or better",
			                  score_gates[b->gate].name);
	}
	if (rule->codes < 0 || rule->codes > 255)
		return err_report(ERR_INPUT, s->path, "codes: %g is not between 0 and 255", rule->codes);
	if (rule->mask) {
		char *path = resolve_path(s->path, rule->mask);
		int err = path ? foreign_read(mask, path) : err_report(ERR_SYSTEM, s->path, "out of memory");

		if (!err && !image_channel(mask, "R"))
			err = err_report(ERR_INPUT, path, "a mask needs a channel R");
		free(path);
		return err;
	}
	return 0;
}

/** Check that presets exist, and inherit only from presets defined before them, so without cycles. */
static int check_presets(const struct score_rules *s)
{
	const struct yaml_file *f = s->file;

	for (uint32_t i = 0; i < f->n_presets; i++) {
		const char *parent = f->presets[i].inherits;

		if (find_preset(f, f->presets[i].name) != &f->presets[i])
			return err_report(ERR_INPUT, s->path, "two presets are named '%s'", f->presets[i].name);
		if (parent && (!find_preset(f, parent) || find_preset(f, parent) >= &f->presets[i]))
			return err_report(ERR_INPUT, s->path, "preset '%s' inherits '%s', which must be defined before it",
			                  f->presets[i].name, parent);
	}
	for (uint32_t i = 0; i < f->n_rules; i++)
		if (f->rules[i].preset && !find_preset(f, f->rules[i].preset))
			return err_report(ERR_INPUT, s->path, "there is no preset '%s'", f->rules[i].preset);
	return 0;
}

static int check_flaky(struct score_rules *s)
{
	for (uint32_t i = 0; i < s->file->n_flaky; i++) {
		const struct yaml_flaky *f = &s->file->flaky[i];
		struct tm day = { 0 };
		time_t now = time(NULL);
		char today[16];
		const char *end = strptime(f->expires, "%Y-%m-%d", &day);

		if (!end || *end || strlen(f->expires) != 10)
			return err_report(ERR_INPUT, s->path, "expires: '%s' is not a date; write it as 2027-01-31", f->expires);
		if (f->n_gates == 0)
			return err_report(ERR_INPUT, s->path, "a flaky entry (%s) names no gates", f->reason);
		strftime(today, sizeof(today), "%Y-%m-%d", gmtime(&now));
		s->is_expired[i] = strcmp(today, f->expires) > 0;
		if (s->is_expired[i])
			err_warn(s->path, "a flaky entry expired on %s and no longer applies: %s", f->expires, f->reason);
	}
	return 0;
}

static int check_all(struct score_rules *s)
{
	struct yaml_file *f = s->file;
	int err;

	s->rule_frames = calloc(f->n_rules + 1, sizeof(*s->rule_frames));
	s->flaky_frames = calloc(f->n_flaky + 1, sizeof(*s->flaky_frames));
	s->preset_masks = calloc(f->n_presets + 1, sizeof(*s->preset_masks));
	s->rule_masks = calloc(f->n_rules + 1, sizeof(*s->rule_masks));
	s->is_expired = calloc(f->n_flaky + 1, sizeof(*s->is_expired));
	s->baseline = f->baseline ? resolve_path(s->path, f->baseline) : NULL;
	if (!s->rule_frames || !s->flaky_frames || !s->preset_masks || !s->rule_masks || !s->is_expired ||
	    (f->baseline && !s->baseline))
		return err_report(ERR_SYSTEM, s->path, "out of memory");
	err = check_presets(s);
	for (uint32_t i = 0; !err && i < f->n_presets; i++)
		err = check_rule(s, &f->presets[i], &s->preset_masks[i]);
	for (uint32_t i = 0; !err && i < f->n_rules; i++) {
		err = check_rule(s, &f->rules[i], &s->rule_masks[i]);
		if (!err && f->rules[i].frames && frame_list_parse(f->rules[i].frames, &s->rule_frames[i]) != 0)
			err = ERR_INPUT;
	}
	for (uint32_t i = 0; !err && i < f->n_flaky; i++)
		if (f->flaky[i].frames && frame_list_parse(f->flaky[i].frames, &s->flaky_frames[i]) != 0)
			err = ERR_INPUT;
	return err ? err : check_flaky(s);
}

int score_rules_read(const char *path, struct score_rules **out)
{
	struct score_rules *s = calloc(1, sizeof(*s));
	int err = ERR_SYSTEM;

	*out = s;
	if (!s || !(s->path = strdup(path)))
		err_report(ERR_SYSTEM, path, "out of memory");
	else
		err = config_load(path, &file_schema, (void **)&s->file);
	if (!err)
		err = check_all(s);
	if (err)
		score_rules_free(out);
	return err;
}

void score_rules_free(struct score_rules **settings)
{
	struct score_rules *s = *settings;

	if (!s)
		return;
	for (uint32_t i = 0; s->file && s->is_expired && i < s->file->n_rules; i++) {
		frame_list_free(&s->rule_frames[i]);
		image_free(&s->rule_masks[i]);
	}
	for (uint32_t i = 0; s->file && s->is_expired && i < s->file->n_presets; i++)
		image_free(&s->preset_masks[i]);
	for (uint32_t i = 0; s->file && s->is_expired && i < s->file->n_flaky; i++)
		frame_list_free(&s->flaky_frames[i]);
	free(s->rule_frames);
	free(s->flaky_frames);
	free(s->preset_masks);
	free(s->rule_masks);
	free(s->is_expired);
	free(s->baseline);
	free(s->path);
	config_free(&file_schema, s->file);
	free(s);
	*settings = NULL;
}

const char *score_rules_baseline(const struct score_rules *settings)
{
	return settings->baseline;
}

static int matches(const char *glob, const struct frame_list *frames, const char *name, uint64_t frame)
{
	return (!glob || fnmatch(glob, name, 0) == 0) && frame_list_contains(frames, frame);
}

static int need_ignore(const struct score_rules *s, uint32_t width, uint32_t height, struct score_rules_frame *out)
{
	const size_t n = (size_t)width * height;

	if (!out->ignore)
		out->ignore = calloc(n ? n : 1, 1);
	return out->ignore ? 0 : err_report(ERR_SYSTEM, s->path, "out of memory");
}

static int apply_mask(const struct score_rules *s, const struct image *mask, uint32_t width, uint32_t height,
                      struct score_rules_frame *out)
{
	const size_t n = (size_t)width * height;
	const float *plane;

	if (mask->n_channels == 0)
		return 0;
	if (mask->width != width || mask->height != height)
		return err_report(ERR_INPUT, s->path, "a mask of %u x %u for frames of %u x %u", mask->width, mask->height,
		                  width, height);
	if (need_ignore(s, width, height, out) != 0)
		return ERR_SYSTEM;
	plane = image_channel(mask, "R");
	for (size_t i = 0; i < n; i++)
		out->ignore[i] |= plane[i] > 0.5f;
	return 0;
}

static int apply_rectangle(const struct score_rules *s, const struct yaml_rectangle *r, uint32_t width, uint32_t height,
                           struct score_rules_frame *out)
{
	if (need_ignore(s, width, height, out) != 0)
		return ERR_SYSTEM;
	for (uint64_t y = r->y; y < (uint64_t)r->y + r->height && y < height; y++)
		for (uint64_t x = r->x; x < (uint64_t)r->x + r->width && x < width; x++)
			out->ignore[y * width + x] = 1;
	return 0;
}

static int apply_rule(const struct score_rules *s, const struct yaml_rule *rule, const struct image *mask,
                      uint32_t width, uint32_t height, struct score_rules_frame *out)
{
	const char *parent = rule->preset ? rule->preset : rule->inherits;
	int err = 0;

	if (parent) {
		const struct yaml_rule *preset = find_preset(s->file, parent);

		err = apply_rule(s, preset, &s->preset_masks[preset - s->file->presets], width, height, out);
	}
	for (uint32_t i = 0; i < rule->n_bars; i++) {
		const struct yaml_bar *b = &rule->bars[i];

		if (out->options.n_bars == SCORE_RULES_MAX_BARS)
			return err_report(ERR_INPUT, s->path, "more than %d bars for one frame", SCORE_RULES_MAX_BARS);
		out->bars[out->options.n_bars++] = (struct score_bar){
			b->gate, b->figure ? (int)b->figure - 1 : 0, b->fail ? *b->fail : NAN, b->warn ? *b->warn : NAN,
			b->better ? *b->better : NAN
		};
	}
	for (uint32_t i = 0; i < rule->n_channels; i++) {
		if (out->options.n_channels == SCORE_RULES_MAX_CHANNELS)
			return err_report(ERR_INPUT, s->path, "more than %d channels for one frame", SCORE_RULES_MAX_CHANNELS);
		out->channels[out->options.n_channels++] = rule->channels[i];
	}
	for (uint32_t i = 0; i < rule->n_effects; i++) {
		const struct yaml_effect *e = &rule->effects[i];

		if (out->options.n_ranges == SCORE_MAX_RANGES)
			return err_report(ERR_INPUT, s->path, "more than %d ranges of effects for one frame", SCORE_MAX_RANGES);
		out->options.ranges[out->options.n_ranges++] =
			(struct score_range){ e->effect, e->low ? *e->low / 100 : NAN, e->high ? *e->high / 100 : NAN };
	}
	if (rule->codes > 0)
		out->options.codes = rule->codes;
	out->options.ignore_alpha |= rule->ignore_alpha;
	if (rule->channel && !out->options.channel)
		out->options.channel = rule->channel;
	err = err ? err : apply_mask(s, mask, width, height, out);
	for (uint32_t i = 0; !err && i < rule->n_ignore; i++)
		err = apply_rectangle(s, &rule->ignore[i], width, height, out);
	return err;
}

int score_rules_for_frame(const struct score_rules *settings, const char *name, uint64_t frame,
                          const struct score_options *base, const uint32_t size[2], struct score_rules_frame *out)
{
	const struct yaml_file *f = settings ? settings->file : NULL;
	int err = 0;

	out->options = *base;
	out->options.bars = out->bars;
	out->options.channels = out->channels;
	for (uint32_t i = 0; f && !err && i < f->n_rules; i++)
		if (matches(f->rules[i].match, &settings->rule_frames[i], name, frame))
			err = apply_rule(settings, &f->rules[i], &settings->rule_masks[i], size[0], size[1], out);
	for (uint32_t i = 0; f && i < f->n_flaky; i++) {
		if (settings->is_expired[i] || !matches(f->flaky[i].match, &settings->flaky_frames[i], name, frame))
			continue;
		for (uint32_t g = 0; g < f->flaky[i].n_gates; g++)
			out->flaky_gates |= 1u << f->flaky[i].gates[g];
		out->flaky_reason = f->flaky[i].reason;
	}
	return err;
}

static void visit_bars(const struct score_rules *s, const struct yaml_rule *rule,
                       void (*visit)(void *, const struct score_rules_entry *), void *user)
{
	const char *parent = rule->preset ? rule->preset : rule->inherits;

	if (parent)
		visit_bars(s, find_preset(s->file, parent), visit, user);
	for (uint32_t i = 0; i < rule->n_bars; i++) {
		const struct yaml_bar *b = &rule->bars[i];

		visit(user, &(struct score_rules_entry){ .key = b,
		                                         .of = rule->name ? rule->name : "a rule",
		                                         .gate = b->gate,
		                                         .figure = b->figure ? (int)b->figure - 1 : 0,
		                                         .fail = b->fail ? *b->fail : NAN });
	}
}

void score_rules_visit(const struct score_rules *settings, const char *name, uint64_t frame,
                       void (*visit)(void *user, const struct score_rules_entry *entry), void *user)
{
	const struct yaml_file *f = settings ? settings->file : NULL;

	for (uint32_t i = 0; f && i < f->n_rules; i++)
		if (matches(f->rules[i].match, &settings->rule_frames[i], name, frame))
			visit_bars(settings, &f->rules[i], visit, user);
	for (uint32_t i = 0; f && i < f->n_flaky; i++) {
		struct score_rules_entry entry = { .key = &f->flaky[i], .of = "flaky", .reason = f->flaky[i].reason };

		if (settings->is_expired[i] || !matches(f->flaky[i].match, &settings->flaky_frames[i], name, frame))
			continue;
		for (uint32_t g = 0; g < f->flaky[i].n_gates; g++)
			entry.flaky_gates |= 1u << f->flaky[i].gates[g];
		visit(user, &entry);
	}
}

int score_rules_ignore_outside(struct score_rules_frame *frame, const uint8_t *outside, size_t n_pixels)
{
	if (outside && !frame->ignore && !(frame->ignore = calloc(n_pixels ? n_pixels : 1, 1)))
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; outside && i < n_pixels; i++)
		frame->ignore[i] |= outside[i];
	return 0;
}

void score_rules_frame_free(struct score_rules_frame *frame)
{
	free(frame->ignore);
	frame->ignore = NULL;
}
