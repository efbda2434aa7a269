/* Runs inside the traced program. */
#include "capture/write/fake.h"

#include <stdarg.h>
#include <string.h>

#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "tables/enums.h"

static uint8_t *put_value(uint8_t *p, char kind, va_list *values)
{
	const void *data;

	switch (kind) {
	case 'e':
		return put_enum(p, va_arg(*values, unsigned));
	case 'u':
		return put_uint(p, va_arg(*values, unsigned));
	case 't':
		return put_bool8(p, va_arg(*values, unsigned));
	case 'm':
		return put_bits(p, va_arg(*values, unsigned), &bits_AttribMask);
	case 'c':
		return put_bits(p, va_arg(*values, unsigned), &bits_ClearBufferMask);
	case 'l':
		return put_sint(p, va_arg(*values, long));
	case 'o':
		return put_opaque(p, va_arg(*values, long));
	case 'f':
		return put_float(p, (float)va_arg(*values, double));
	case 's':
		data = va_arg(*values, const char *);
		return put_string(p, data, (long)strlen(data));
	case 'b':
		data = va_arg(*values, const void *);
		return put_own_blob(p, data, va_arg(*values, long));
	default:
		return put_sint(p, va_arg(*values, int));
	}
}

void fake_call(unsigned command, const char *kinds, ...)
{
	uint8_t *p = writer_enter_fake(command);
	va_list values;

	if (!p)
		return;
	va_start(values, kinds);
	for (unsigned i = 0; kinds[i]; i++)
		p = put_value(put_argument(p, i), kinds[i], &values);
	va_end(values);
	writer_call_end(p);
}
