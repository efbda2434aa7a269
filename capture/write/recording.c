/* Runs inside the traced program. */
#include "capture/write/recording.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "capture/stats.h"
#include "capture/write/report.h"
#include "capture/write/sink.h"

struct recording recording;

/* End the recording, once, where the file has failed. */
static void look_for_errors(void)
{
	struct sink_state sink = sink_state();

	recording.process->bytes = sink.bytes;
	recording.process->calls = recording.n_calls;
	if (!sink.error || recording.state == RECORDING_ENDED)
		return;
	recording.state = RECORDING_ENDED;
	recording.process->failed = sink.error;
	report_say("%s: %s: %s; recording ends after frame %llu, the program goes on", sink.path, sink.what, strerror(sink.error),
	           (unsigned long long)recording.n_frames);
}

void recording_open(const char *name)
{
	recording.process = report_new_process();
	recording.chunk = sink_open(name);
	snprintf(recording.process->path, sizeof(recording.process->path), "%s", sink_state().path);
	recording.state = RECORDING_ON;
	look_for_errors();
	recording.end = recording.chunk ? recording.chunk + SINK_CHUNK : NULL;
}

uint8_t *recording_spill(uint8_t *p, int now)
{
	size_t bytes = (size_t)(p - recording.chunk);
	int saved = errno;

	if (recording.state == RECORDING_ON) {
		recording.chunk = now ? sink_write(bytes) : sink_hand_over(bytes);
		recording.end = recording.chunk + SINK_CHUNK;
		look_for_errors();
	}
	errno = saved;
	return recording.chunk;
}
