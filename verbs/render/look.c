/* relume look: a recording -> scenes -> rules. */
#include "verbs/render/look.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/options.h"
#include "base/part.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "look/rules/findings.h"
#include "look/rules/rules.h"
#include "look/study/study.h"
#include "scene/release.h"
#include "verbs/render/surfaces.h"

struct asked {
	struct frame_list frames;
	const char *output, *sheet, *device;
};

static const struct options_row rows[] = {
	{ "frames", 'f', "LIST",
	  "frames to study, counted from 0: \"7\", \"1-500\", \"55-\" to the end, \"1-500x5\", with commas (default: all); "
	  "of many only some, evenly spread",
	  options_frames, .at = offsetof(struct asked, frames) },
	{ "output", 'o', "FILE", "the rules, as NAME.look.yaml", options_text, .at = offsetof(struct asked, output),
	  .use = CONFINE_MAKES },
	{ "sheet", 0, "FILE.html",
	  "a page that shows one frame, the first of --frames or the recording's middle one: point at a "
	  "surface to see its draw, mesh, textures and material, and a rule for it; below are all textures and meshes. "
	  "Without -o nothing is studied",
	  options_text, .at = offsetof(struct asked, sheet), .use = CONFINE_MAKES },
	{ "device", 'd', "DEVICE",
	  "for --sheet: a number from 'relume devices', cpu, gpu, accelerator, part of a name, or reference "
	  "(default: the first GPU, else CPU)",
	  options_text, .at = offsetof(struct asked, device) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "look",
	.head = "usage: relume look TRACE [-f FRAMES] -o FILE\n"
		"       relume look TRACE [-f FRAME] --sheet FILE.html\n"
		"\n"
		"Study a recording, and write rules for relume render --look: the camera, objects that never move,\n"
		"tricks that imitate light, and lights. Each rule has a confidence and a reason. Edit the file to\n"
		"overrule it: 'relume help look-file'.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace, and -o FILE or --sheet FILE.html",
	.least = 1,
	.most = 1,
	.words_use = CONFINE_RECORDING,
};

/* Play the frames of a list, of too many every so often one, into a study. */
static int play(struct replay *replay, const char *trace, const struct frame_list *frames, struct study *study)
{
	uint64_t end, total, frame = 0, i = 0;
	int damaged, err = replay_frame_count(replay, &end, &damaged), more = 1;

	if (err)
		return err;
	total = frame_list_count(frames, end);
	if (!total)
		return err_report(end ? ERR_USAGE : ERR_INPUT, trace, end ? "has %llu frame%s; none of those asked for is there" :
		                  "holds no whole frame", (unsigned long long)end, plural(end));
	for (; more == 1 && !err && frame_list_next(frames, frame, &frame) && frame < end; frame++, i++) {
		struct scene *scene = NULL;

		if (total > study_most_frames() && i * study_most_frames() / total == (i + 1) * study_most_frames() / total)
			continue;
		more = replay_seek(replay, frame);
		if (more == 1)
			more = replay_next_frame(replay, 1, &scene);
		if (more == 1)
			err = study_add(study, scene);
		scene_release(&scene);
	}
	if (!err && more >= 0)
		err = study_finish(study);
	return err ? err : more < 0 ? more : 0;
}

/* out: empty; findings_free in any case */
static int study_trace(const char *trace, const struct frame_list *frames, struct findings *out)
{
	struct replay *replay = NULL;
	struct study *study = NULL;
	int err = study_create(&study);

	if (!err)
		err = replay_open(&replay, trace);
	if (!err)
		err = play(replay, trace, frames, study);
	if (!err)
		err = study_find(study, out);
	replay_close(&replay);
	study_destroy(&study);
	return err;
}

int look_study(const char *trace, const struct frame_list *frames, struct look **look)
{
	struct findings findings = { .n = 0 };
	int err = study_trace(trace, frames, &findings);

	if (!err)
		err = rules_from_findings("--look auto", &findings, look);
	findings_free(&findings);
	return err;
}

int look_fetch_unseen(struct replay *replay, struct look *look)
{
	int more = 1;

	for (uint32_t i = 0; look && i < look->rules->unseen_count && more >= 0; i++) {
		more = replay_seek(replay, *look->rules->unseen[i].frame);
		if (more == 1)
			more = replay_next_frame(replay, 1, &look->unseen[i].scene);
	}
	return more < 0 ? more : 0;
}

static int write_rules(const struct findings *findings, const char *trace, const char *path)
{
	struct part_file file;
	int err = folder_make_for(path);

	if (!err)
		err = part_open(&file, path);
	if (err)
		return err;
	findings_write(findings, trace, file.stream);
	return part_close(&file, 0);
}

/* The frame that a sheet shows: the first one asked for, or the middle of all. */
static int choose_frame(struct replay *replay, const struct frame_list *frames, uint64_t *frame)
{
	uint64_t end;
	int damaged, err = frames->n_ranges ? 0 : replay_frame_count(replay, &end, &damaged);

	if (err)
		return err;
	if (frames->n_ranges)
		frame_list_next(frames, 0, frame);
	else
		*frame = end / 2;
	return 0;
}

static int write_sheet(const struct asked *asked, const char *trace)
{
	struct single single = { .scene = NULL };
	uint64_t frame = 0;
	int err = single_open(trace, asked->device, &single);

	if (!err)
		err = choose_frame(single.replay, &asked->frames, &frame);
	if (!err)
		err = replay_take_frame(single.replay, trace, frame, &single.scene);
	if (!err)
		err = single_render(&single, "gl,id");
	if (!err)
		err = surfaces_write(&single, trace, asked->sheet);
	single_free(&single);
	return err;
}

static int study_and_write(const struct asked *asked, const char *trace)
{
	struct findings findings = { .n = 0 };
	int err = study_trace(trace, &asked->frames, &findings);

	if (!err)
		err = write_rules(&findings, trace, asked->output);
	findings_free(&findings);
	return err;
}

int look_main(int argc, char **argv)
{
	struct asked asked = { .output = NULL };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &asked, &line);

	if (!err && !asked.output && !asked.sheet)
		err = options_misuse(&table);
	if (!err)
		err = options_confine(&table, &line, asked.sheet ? CONFINE_TRACER : CONFINE_READER, NULL);
	if (!err && asked.output)
		err = study_and_write(&asked, line.words[0]);
	if (!err && asked.sheet)
		err = write_sheet(&asked, line.words[0]);
	frame_list_free(&asked.frames);
	return err > 0 ? 0 : -err;
}
