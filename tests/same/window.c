/* The same picture through a framebuffer object, and in a larger window. */
#include "tests/same/relations.h"

#include <math.h>
#include <stdio.h>

#include "gl_tokens.h"
#include "replay/gl/surface/drawable.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "tests/same/story.h"

static void make_target(struct story *s)
{
	const struct gls_state *st = s->x->st;
	const struct gls_drawable *d = gls_drawable_of(s->x, st->drawable);

	if (st->samples > 1 || !st->double_buffered)
		not_for(s, "the window has several samples, or no back buffer");
	s->target = OURS;
	s->step = d->width << 16 | d->height;
	say(s, "glBindTexture", "uu", GL_TEXTURE_2D, OURS);
	say(s, "glTexParameteri", "uuu", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	say(s, "glTexParameteri", "uuu", GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	say(s, "glTexImage2D", "uuuuuuuun", GL_TEXTURE_2D, 0, st->alpha_bits ? GL_RGBA8 : GL_RGB8, d->width, d->height,
	    0, GL_RGBA, GL_UNSIGNED_BYTE);
	say(s, "glBindTexture", "uu", GL_TEXTURE_2D, st->a.texturing.units[st->a.texturing.active].bound[GLS_TEXTURE_2D]);
	say(s, "glBindRenderbuffer", "uu", GL_RENDERBUFFER, OURS);
	say(s, "glRenderbufferStorage", "uuuu", GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, d->width, d->height);
	say(s, "glBindRenderbuffer", "uu", GL_RENDERBUFFER, st->renderbuffer);
	say(s, "glBindFramebuffer", "uu", GL_FRAMEBUFFER, OURS);
	say(s, "glFramebufferTexture2D", "uuuuu", GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, OURS, 0);
	say(s, "glFramebufferRenderbuffer", "uuuu", GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, OURS);
	say(s, "glFramebufferRenderbuffer", "uuuu", GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, OURS);
}

void call_target(struct story *s, const struct call *c, int draws)
{
	const struct gls_state *st = s->x->st;
	const uint32_t kind = c->sig->command >= 0 ? gls_commands[c->sig->command].kind : GLS_KIND_NONE;

	if (s->x->n_contexts > 1 || begins(c, "glAccum") ||
	    (begins(c, "glDrawBuffer") && arg_u(c, 0) == GL_FRONT && !(c->flags & CALL_FAKE)))
		not_for(s, "it has several contexts, or draws to more than the back buffer");
	/* The recorder's own calls draw to the front buffer first. */
	if (st && !s->target && !st->list && !(c->flags & CALL_FAKE) &&
	    (draws || (kind == GLS_KIND_STATE && !begins(c, "glDrawBuffer"))))
		make_target(s);
	if (s->target && begins(c, "glBindFramebuffer") && arg_u(c, 1) == 0)
		say(s, "glBindFramebuffer", "uu", arg_u(c, 0), s->target);
	else if (!s->target || !((begins(c, "glDrawBuffer") && !st->draw_framebuffer) ||
	                         (begins(c, "glReadBuffer") && !st->read_framebuffer)))
		say_call(s, c);
}

/* amount 1: as a textured quad */
void frame_target(struct story *s)
{
	const struct gls_drawable *d = gls_drawable_of(s->x, s->x->st->drawable);
	const uint32_t bound = s->x->st->draw_framebuffer;

	if (!s->target)
		return;
	if (s->step != (d->width << 16 | d->height))
		not_for(s, "the window's size changes");
	say(s, "glBindFramebuffer", "uu", GL_FRAMEBUFFER, 0);
	begin_flat(s, mat4_identity);
	if (s->relation->amount > 0) {
		say(s, "glViewport", "uuuu", 0, 0, d->width, d->height);
		say(s, "glActiveTexture", "u", GL_TEXTURE0);
		say(s, "glBindTexture", "uu", GL_TEXTURE_2D, OURS);
		say(s, "glEnable", "u", GL_TEXTURE_2D);
		say(s, "glTexEnvi", "uuu", GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
		for (unsigned i = 0; i < 4; i++)
			say(s, "glDisable", "u", GL_TEXTURE_GEN_S + i);
		say(s, "glMatrixMode", "u", GL_TEXTURE);
		say(s, "glPushMatrix", "");
		say(s, "glLoadIdentity", "");
		say(s, "glBegin", "u", GL_QUADS);
		for (unsigned i = 0; i < 4; i++) {
			say(s, "glTexCoord2f", "ff", (double)(i == 1 || i == 2), (double)(i > 1));
			say(s, "glVertex2f", "ff", i == 1 || i == 2 ? 1.0 : -1.0, i > 1 ? 1.0 : -1.0);
		}
		say(s, "glEnd", "");
		say(s, "glPopMatrix", "");
	} else {
		say(s, "glBindFramebuffer", "uu", GL_READ_FRAMEBUFFER, s->target);
		say(s, "glBlitFramebuffer", "uuuuuuuuuu", 0, 0, d->width, d->height, 0, 0, d->width, d->height,
		    GL_COLOR_BUFFER_BIT, GL_NEAREST);
	}
	end_flat(s);
	say(s, "glBindFramebuffer", "uu", GL_FRAMEBUFFER, bound ? bound : s->target);
}

void call_thrice(struct story *s, const struct call *c, int draws)
{
	unsigned width, height;
	char text[80];
	size_t n;
	const char *marker =
	    c->n_args > 1 && c->args[1].type == TRACE_STRING ? c->args[1].str : (const char *)arg_blob(c, 1, &n);

	if (s->x->st && !s->target && (draws || is(c, "glClear")) && !s->x->st->list) {
		s->target = 1;
		for (unsigned unit = 0; unit < GLS_MAX_UNITS; unit++) { /* preserves the level of detail */
			say(s, "glActiveTexture", "u", GL_TEXTURE0 + unit);
			say(s, "glTexEnvf", "uuf", GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, log2(3));
		}
		say(s, "glActiveTexture", "u", GL_TEXTURE0 + s->x->st->a.texturing.active);
	}
	if (begins(c, "glBitmap") || begins(c, "glDrawPixels") || begins(c, "glDrawTex") || begins(c, "glCopy") ||
	    begins(c, "glReadPixels") || begins(c, "glBindFramebuffer"))
		not_for(s, "pixels do not grow with the window");
	if ((is(c, "glBegin") || begins(c, "glDrawArrays") || begins(c, "glDrawElements") || begins(c, "glDrawRange")) &&
	    gls_mode_kind(arg_u(c, 0)) != SCENE_TRIANGLES)
		not_for(s, "lines and points are clipped differently");
	if (is(c, "glViewport") || is(c, "glScissor")) {
		say(s, c->sig->name[2] == 'V' ? "glViewport" : "glScissor", "uuuu", 3 * arg_u(c, 0), 3 * arg_u(c, 1),
		    3 * arg_u(c, 2), 3 * arg_u(c, 3));
	} else if (is(c, "glPolygonOffset")) {
		say(s, "glPolygonOffset", "ff", 3 * arg_d(c, 0), arg_d(c, 1));
	} else if (is(c, "glStringMarkerGREMEDY") && marker && sscanf(marker, "relume:drawable %u %u", &width, &height) == 2) {
		snprintf(text, sizeof(text), "relume:drawable %u %u", 3 * width, 3 * height);
		say(s, "glStringMarkerGREMEDY", "us", (uint32_t)strlen(text), text);
	} else {
		say_call(s, c);
	}
	s->n_changes++;
}
