/* Kinds of modelview matrices. */
#pragma once

enum modelview_kind {
	MODELVIEW_PLAIN,
	MODELVIEW_MIRRORED, /* swaps left and right hands */
	MODELVIEW_SINGULAR, /* flattens things to a plane */
	N_MODELVIEW_KINDS
};

/** The kind with a name used in rules; N_MODELVIEW_KINDS: there is none. */
enum modelview_kind modelview_named(const char *name);

enum modelview_kind modelview_kind_of(const float modelview[16]);
