#include "verbs/render/seen.h"

#include "look/apply/apply.h"
#include "look/apply/unseen.h"

static int apply_rules(const struct settings *settings, struct seen *s)
{
	int err = unseen_add(settings->look, s->scene, &s->whole);

	if (err)
		return err;
	err = look_apply(settings->look, s->whole.instances ? &s->whole : s->scene, &s->changed, &s->found);
	s->scene = &s->changed;
	return err;
}

int seen_make(const struct settings *settings, uint64_t number, struct seen *s)
{
	int err = 0;

	s->scene = s->recorded;
	if (settings->tracer.mode != TRACER_GL)
		err = apply_rules(settings, s);
	if (!err && settings_resize(settings)) {
		err = scaled_make(s->scene, settings->scale, settings->size, &s->scaled);
		s->scene = &s->scaled.scene;
	}
	if (!err && settings->camera) {
		err = elsewhere_make(settings->camera, settings->look, s->scene, (uint32_t)number, &s->elsewhere);
		s->scene = &s->elsewhere.scene;
	}
	return err;
}

void seen_release(struct seen *s)
{
	elsewhere_release(&s->elsewhere);
	scaled_release(&s->scaled);
	if (s->changed.instances)
		look_release(&s->changed);
	spare_free(&s->found);
	unseen_release(&s->whole);
	between_release(&s->between);
	*s = (struct seen){ .scene = NULL };
}
