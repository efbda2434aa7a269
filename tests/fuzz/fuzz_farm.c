/* A job's folder: its arguments (the input, after the folder they were typed in), its script generated again, its
 * tasks. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/fuzz/target.h"
#include "verbs/farm/job.h"
#include "verbs/farm/script.h"

static char home[4096];
static FILE *nowhere;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct farm_job job = { 0 };
	char path[4096], folder[4096];
	size_t n = strlen(target_folder()) + 1;
	uint8_t *all = malloc(n + size + 1);

	nowhere = nowhere ? nowhere : fopen("/dev/null", "w");
	if (!all || (!home[0] && !getcwd(home, sizeof(home))))
		abort();
	snprintf(folder, sizeof(folder), "%s/x.farm", target_folder());
	mkdir(folder, 0777);
	memcpy(all, target_folder(), n);
	memcpy(all + n, data, size);
	target_write("x.farm/arguments", all, n + size, path);
	if (!farm_job_load(folder, &job)) {
		farm_script_print(&job, nowhere);
		farm_job_task_of(&job, 0);
		farm_job_task_of(&job, frame_list_last(&job.pictures));
	}
	farm_job_free(&job);
	free(all);
	if (chdir(home))
		abort();
	return 0;
}
