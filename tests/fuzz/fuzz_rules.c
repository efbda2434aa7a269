/* relume-diff.yaml: how frames are compared. */
#include <unistd.h>

#include "diff/rules/rules.h"
#include "tests/fuzz/target.h"

static void visit(void *user, const struct score_rules_entry *entry)
{
	(void)user;
	(void)entry;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	const struct score_options base = { 0 };
	const uint32_t picture[2] = { 40, 30 };
	struct score_rules *rules = NULL;
	struct score_rules_frame frame = { .ignore = NULL };
	char path[32];
	int file = target_file(data, size, path);

	if (!score_rules_read(path, &rules)) {
		score_rules_baseline(rules);
		score_rules_visit(rules, "gears", 7, visit, NULL);
		score_rules_for_frame(rules, "gears", 7, &base, picture, &frame);
		score_rules_frame_free(&frame);
	}
	score_rules_free(&rules);
	close(file);
	return 0;
}
