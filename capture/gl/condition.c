#include "capture/gl/condition.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>

#include "capture/gl/context.h"
#include "capture/gl/marker.h"
#include "real.h"

#define UNANSWERED 0xffffffffu /* not a valid query, or still counting: the call itself is an error */

void condition_write(unsigned query)
{
	unsigned count = UNANSWERED;
	char text[48];

	context_errors_before();
	real_glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
	context_errors_after();
	if (count == UNANSWERED)
		return;
	snprintf(text, sizeof(text), "relume:condition %u", count);
	marker_write(text);
}
