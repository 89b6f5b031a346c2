#include <app/look.h>
