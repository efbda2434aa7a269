#include "verbs/render/carried.h"

#define MOST_IN_ROW 8 /* bad frames: a device that fails on more has broken down */
#define MOST_FAULTS (sizeof(((struct outcome_run *)0)->faults) / sizeof(struct fault))

void carried_set_done(struct carried *c, uint64_t frame)
{
	if (frame < CARRIED_FRAMES)
		c->done[frame / 8] |= (unsigned char)(1u << frame % 8);
}

int carried_is_done(const struct carried *c, uint64_t frame)
{
	return frame < CARRIED_FRAMES && c->done[frame / 8] >> frame % 8 & 1;
}

int carried_take_fault(struct carried *c)
{
	const struct fault fault = c->guard.last;
	char text[160];

	c->first = FAULT_NO_FRAME;
	if (fault.kind == FAULT_NONE)
		return 0;
	if (fault.device < 0)
		return err_report(
			ERR_SYSTEM, "OpenCL",
			"a driver fails when it lists its devices (%s); repair it, or use --device reference (slow)",
			fault_words(&fault, text, sizeof(text)));
	for (size_t i = 0; i < c->run.n; i++)
		if (c->run.faults[i].device == fault.device && c->run.faults[i].family == fault.family)
			return err_report(ERR_SYSTEM, "OpenCL",
			                  "device %d fails before it runs a kernel (%s): choose another --device, or "
			                  "--device reference (slow)",
			                  fault.device, fault_words(&fault, text, sizeof(text)));
	if (c->run.n == MOST_FAULTS || fault.family < 0 || fault.family >= N_DEVICE_FAMILIES)
		return err_report(ERR_SYSTEM, "OpenCL", "too many drivers fail (%s): choose another --device",
		                  fault_words(&fault, text, sizeof(text)));
	c->run.faults[c->run.n++] = fault;
	c->first = fault.is_build ? FAULT_NO_FRAME : fault.frame;
	c->is_confirmed = 0;
	return 0;
}

int carried_confirms(struct carried *c, const struct device *dev)
{
	const struct device_description *device = device_describe(dev);

	if (c->is_confirmed || !c->run.n || !device || c->run.faults[c->run.n - 1].device != (int)device->number)
		return 0;
	c->is_confirmed = 1;
	return 1;
}

/* Launches may do better with another frame; compilers never do. @return how many different frames they had, as far as
 * is known */
static int forget_launches(struct outcome_run *run)
{
	const int64_t last = run->faults[run->n - 1].frame;
	int n_frames = 1;
	size_t kept = 0;

	for (size_t i = 0; i < run->n; i++)
		if (run->faults[i].is_build)
			run->faults[kept++] = run->faults[i];
		else
			n_frames += run->faults[i].frame != last;
	run->n = kept;
	return n_frames;
}

int carried_blame_frame(struct carried *c)
{
	const struct fault last = c->run.faults[c->run.n ? c->run.n - 1 : 0];
	char text[160];

	if (c->made != c->made_then)
		c->in_row = 0;
	if (c->run.n == 0 || last.is_build || c->made == 0 || c->in_row == MOST_IN_ROW || (last.frame < 0 && c->one_by_one))
		return 0;
	if (last.frame < 0)
		c->one_by_one = 1;
	if (forget_launches(&c->run) > 1 || last.frame < 0)
		return 1;
	c->made_then = c->made;
	c->in_row++;
	err_report(ERR_SYSTEM, NULL, "frame %lld: the driver fails on it (%s); the run goes on", (long long)last.frame,
	           fault_words(&last, text, sizeof(text)));
	carried_set_done(c, (uint64_t)last.frame);
	progress_frame(&c->progress, (uint64_t)last.frame, "failed", 0);
	return 1;
}
