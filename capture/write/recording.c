/* Runs inside the traced program. */
#include "capture/write/recording.h"

#include <errno.h>
#include <stdio.h>

#include "capture/stats.h"
#include "capture/write/report.h"
#include "capture/write/sink.h"

struct recording recording;

/* End the recording, once, after a write error. The figures describe the file, without what was lost. */
static void look_for_errors(void)
{
	struct sink_state sink = sink_state();
	char reason[128];

	recording.process->bytes = sink.bytes;
	recording.process->calls = sink.content.calls;
	recording.process->frames = sink.content.frames;
	if (!sink.error || recording.state == RECORDING_ENDED)
		return;
	recording.state = RECORDING_ENDED;
	recording.process->failed = sink.error;
	sink_explain(reason, sizeof(reason), sink.what, sink.error);
	report_say("%s: %s: recording stopped after %llu frame%s; %s", sink.path, reason,
	           (unsigned long long)sink.content.frames, sink.content.frames == 1 ? "" : "s",
	           recording.quits ? "the program ends as well (--quit-after)" : "the program keeps running");
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
		struct sink_content content = { recording.n_frames, recording.n_calls };

		recording.chunk = now ? sink_write(bytes, content) : sink_hand_over(bytes, content);
		recording.end = recording.chunk + SINK_CHUNK;
		look_for_errors();
	}
	errno = saved;
	return recording.chunk;
}
