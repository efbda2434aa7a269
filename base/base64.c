#include "base/base64.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

char *base64_url(const char *type, const uint8_t *bytes, size_t n)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	const size_t head = strlen("data:;base64,") + strlen(type);
	char *text = malloc(head + (n + 2) / 3 * 4 + 1), *to;

	if (!text) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		return NULL;
	}
	to = text + sprintf(text, "data:%s;base64,", type);
	for (size_t i = 0; i < n; i += 3) {
		const size_t left = n - i;
		const uint32_t second = left > 1 ? bytes[i + 1] : 0, third = left > 2 ? bytes[i + 2] : 0;
		const uint32_t group = (uint32_t)bytes[i] << 16 | second << 8 | third;

		*to++ = digits[group >> 18];
		*to++ = digits[group >> 12 & 63];
		*to++ = left > 1 ? digits[group >> 6 & 63] : '=';
		*to++ = left > 2 ? digits[group & 63] : '=';
	}
	*to = '\0';
	return text;
}
