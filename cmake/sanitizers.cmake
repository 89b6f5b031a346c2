# MOBBSCOPE_SANITIZE reaches every target, ours and generated: a mix reports faults that are none.
if(MOBBSCOPE_SANITIZE)
  add_compile_options(-fsanitize=${MOBBSCOPE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${MOBBSCOPE_SANITIZE})
endif()
