/* Float textures whose bytes are all equal: a recording of a few hundred kilobytes that needs gigabytes. Recorded by
 * test_limits.py. */
#include "tests/trace/window.h"

enum { SIDE = 2048, TEXTURES = 40 };

static unsigned char texels[SIDE * SIDE];

int main(void)
{
	open_window();
	for (unsigned i = 1; i <= TEXTURES; i++) {
		glBindTexture(GL_TEXTURE_2D, i);
		glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE32F_ARB, SIDE, SIDE, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, texels);
	}
	end_frame();
	return 0;
}
