#include <app/settings.h>
