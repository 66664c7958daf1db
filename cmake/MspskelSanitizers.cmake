# Applies MSPSKEL_SANITIZE, for example "address,undefined", to one of our targets.
function(mspskel_target_sanitizers target)
  if(MSPSKEL_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${MSPSKEL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${MSPSKEL_SANITIZE})
  endif()
endfunction()
