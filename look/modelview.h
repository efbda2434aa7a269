/* What kind of modelview matrix something was drawn with. */
#pragma once

enum modelview_kind {
	MODELVIEW_PLAIN,
	MODELVIEW_MIRRORED, /* turns left hands into right ones */
	MODELVIEW_SINGULAR, /* flattens: what is drawn has no thickness */
	N_MODELVIEW_KINDS
};

/** The kind of a name as rules have it; N_MODELVIEW_KINDS: there is none. */
enum modelview_kind modelview_named(const char *name);

enum modelview_kind modelview_kind_of(const float modelview[16]);
