/* Baselines written by relume approve: frames in any order, their files, and foreign folders (diff/baseline). */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/verbs.h"
#include "diff/baseline/baseline.h"
#include "tests/alone.h"
#include "tests/said.h"
#include "tracer/image/image.h"

static void setup(void)
{
	alone_enter();
	ck_assert_int_eq(mkdir("traced", 0777), 0);
}

static void trace_frame(unsigned frame, float red)
{
	struct image img = { .width = 2, .height = 2 };
	char path[64];

	for (int c = 0; c < 3; c++) {
		float *plane = image_add_channel(&img, (const char[]){ "RGB"[c], 0 }, 1);

		for (int i = 0; i < 4; i++)
			plane[i] = red;
	}
	image_set_attribute(&img, "relume:device", "a device");
	image_set_attribute(&img, "relume:trace", "0123");
	snprintf(path, sizeof(path), "traced/x.%04u.exr", frame);
	ck_assert_int_eq(image_write_exr(&img, path), 0);
	image_free(&img);
}

static void approve(const char *frames, const char *option)
{
	char *arguments[] = { "approve", "-f", (char *)frames, "traced", "base", (char *)option, NULL };

	ck_assert_int_eq(approve_main(option ? 6 : 5, arguments), 0);
}

static int is_stored(unsigned frame)
{
	char path[64];

	snprintf(path, sizeof(path), "base/a_device/frame.%04u.exr", frame);
	return access(path, R_OK) == 0;
}

/* The baseline must list the frames whose bits are set, in order, and each must be found. */
static void check_frames(uint64_t wanted)
{
	struct baseline base = { 0 };
	const struct baseline_variant *v;
	uint64_t found = 0;

	ck_assert_int_eq(baseline_open("base", &base), 0);
	ck_assert_uint_eq(base.n_variants, 1);
	ck_assert_int_eq(baseline_variant_of(&base, "a device"), 0);
	v = base.variants[0];
	for (uint32_t i = 0; i < v->n_frames; i++) {
		ck_assert(i == 0 || v->frames[i - 1].frame < v->frames[i].frame);
		ck_assert_ptr_eq(baseline_find(v, v->frames[i].frame), &v->frames[i]);
		ck_assert_uint_eq(v->frames[i].width, 2);
		found |= 1ull << v->frames[i].frame;
	}
	ck_assert_uint_eq(found, wanted);
	ck_assert_ptr_null(baseline_find(v, 63));
	baseline_close(&base);
}

/* Frames are approved in any order, many at once; lines stay sorted, and each frame keeps its own hashes. */
START_TEST(test_order)
{
	const uint64_t approved = ((1ull << 60) - (1ull << 30)) | 0xf8;

	for (unsigned frame = 0; frame < 60; frame++)
		trace_frame(frame, (float)frame / 64);
	approve("30-59", NULL);
	approve("7", NULL);
	approve("3-5", NULL);
	approve("6", NULL);
	check_frames(approved);
	trace_frame(6, 0.75f);
	approve("6,7", NULL);
	check_frames(approved);
	ck_assert(is_stored(3) && is_stored(59) && !is_stored(8));
}
END_TEST

/* Frame files are added, and removed by --hashes. */
START_TEST(test_files)
{
	trace_frame(1, 0.25f);
	approve("1", NULL);
	ck_assert(is_stored(1));
	approve("1", "--hashes");
	ck_assert(!is_stored(1));
	approve("1", "-n");
	ck_assert(!is_stored(1));
	approve("1", NULL);
	ck_assert(is_stored(1));
	approve("1", "--hashes");
	trace_frame(1, 0.5f);
	approve("1", "--hashes");
	ck_assert(!is_stored(1));
	approve("1", NULL);
	ck_assert(is_stored(1));
	check_frames(2);
}
END_TEST

/* A file that was reordered by hand is still read. Folders that are hidden, or hold no baseline, are left alone. */
START_TEST(test_other_folders)
{
	static const char sheet[] = "format: relume-baseline\nversion: 1\ndevice: \"a device\"\ntrace: "
	                            "\"0123\"\nrelume: \"\"\nsettings: \"\"\napproved_by: \"x\"\n"
				    "approved_at: \"2001-09-09T01:46:40Z\"\nreason: \"\"\nframes:\n"
				    "- {frame: 9, width: 2, height: 2, channels: \"A:1\"}\n- {frame: 2, width: 2, "
	                            "height: 2, channels: \"A:2\"}\n"
				    "- {frame: 5, width: 2, height: 2, channels: \"A:3\"}\n- {frame: 4, width: 2, "
	                            "height: 2, channels: \"A:4\"}\n";

	ck_assert_int_eq(mkdir("base", 0777) | mkdir("base/.git", 0777) | mkdir("base/notes", 0777) |
	                         mkdir("base/a_device", 0777),
	                 0);
	said_write_file("base/.git/baseline.yaml", "format: another\n");
	said_write_file("base/a_device/baseline.yaml", sheet);
	check_frames(1 << 9 | 1 << 2 | 1 << 5 | 1 << 4);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("approve");

	tcase_add_checked_fixture(tcase, setup, NULL);
	tcase_add_test(tcase, test_order);
	tcase_add_test(tcase, test_files);
	tcase_add_test(tcase, test_other_folders);
	return run_alone_in_folders(tcase, "approve");
}
